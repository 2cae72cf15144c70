"""Opens a page in headless Chromium, clicks every button of it, and fails where the browser reports an error, a picture stays empty, or
anything runs off the page to the right, on a screen of 1280 pixels and on A4 paper.

check_page.py PAGE [--screenshot FILE]; ends with 77 (skipped) where Chromium is not installed.
"""
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile

PROBE = """
<script>
window.addEventListener("load", () => {
  const problems = [];
  window.addEventListener("error", e => problems.push(e.message));
  document.querySelectorAll("button").forEach(button => { try { button.click(); } catch (e) { problems.push(e.message); } });
  document.querySelectorAll("canvas").forEach((canvas, i) => {
    const pixels = canvas.getContext("2d").getImageData(0, 0, canvas.width, canvas.height).data;
    if (!pixels.some(value => value !== 0)) problems.push("picture " + i + " is empty");
  });
  const wide = (element, room = 1) => element.scrollWidth > element.clientWidth + room;
  // Drawings that were made before the scroll bar appeared are as much too wide.
  if (wide(document.documentElement, 16)) problems.push("the page is wider than its window");
  [...document.querySelectorAll(".scroll")].filter(frame => wide(frame)).forEach(frame => problems.push("runs off the page: the table that begins with " + frame.innerText.slice(0, 60)));
  const seen = document.createElement("div");
  seen.id = "seen";
  seen.textContent = JSON.stringify({ problems, buttons: document.querySelectorAll("button").length, pictures: document.querySelectorAll("canvas").length });
  document.body.appendChild(seen);
});
</script>
"""


SCREEN, PAPER = 1280, 703  # pixels; A4 without its margins has 186 mm


def chromium(*arguments, page, width=SCREEN):
    program = shutil.which("chromium") or shutil.which("chromium-browser")
    if not program:
        sys.exit(77)
    with tempfile.TemporaryDirectory() as profile:
        return subprocess.run([program, "--headless", "--no-sandbox", "--use-angle=swiftshader", "--enable-unsafe-swiftshader", "--enable-logging=stderr", f"--user-data-dir={profile}",
                               "--virtual-time-budget=5000", f"--window-size={width},2400", *arguments, page.absolute().as_uri()],
                              capture_output=True, text=True, timeout=120)


def check(text, width):
    with tempfile.TemporaryDirectory() as folder:
        probed = pathlib.Path(folder, "probed.html")
        probed.write_text(text.replace("<head>", "<head>" + PROBE, 1))
        run = chromium("--dump-dom", page=probed, width=width)
    seen = re.search(r'<div id="seen">(.*?)</div>', run.stdout)
    errors = [line for line in run.stderr.splitlines() if "CONSOLE" in line]
    print(f"{width} pixels:", seen.group(1) if seen else "the page did not load", *errors, sep="\n")
    assert seen and '"problems":[]' in seen.group(1) and not errors
    assert '"pictures":0' not in seen.group(1)


def main(page, *options):
    page = pathlib.Path(page)
    if options[:1] == ("--screenshot",):
        chromium(f"--screenshot={options[1]}", page=page)
    text = page.read_text()
    assert not re.search(r'(src|href)\s*=\s*"(https?:)?//', text), "the page fetches something"
    check(text, SCREEN)
    check(text.replace("@media print", "@media all"), PAPER)


main(*sys.argv[1:])
