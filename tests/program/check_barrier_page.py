"""Opens the report of a barrier's type test in headless Chromium, filled with barrier_report_sample.json and with copies of it that lack things.

check_barrier_page.py SOURCE [--write PAGE]; the page is put together as page.cpp and report.cpp do it. Ends with 77 (skipped) where Chromium is not installed.
"""
import copy
import json
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile
import unittest

SCRIPTS = [f"report/{name}.js" for name in ("units", "frames", "renderer", "gestures", "legend", "replay")] + [
    f"barrier/{name}.js" for name in ("sizes", "verdict", "svg", "curves", "drawing")]
PHONE, SCREEN, PAPER, PAPER_HEIGHT = 390, 1200, 703, 1032  # pixels; A4 without its margins has 186 mm by 273 mm

# Looks at the page from inside and tells the page around it, whose frame gives it its width.
PROBE = """
<script>
const problems = [];
window.requestAnimationFrame = act => setTimeout(() => act(performance.now()), 16);
window.addEventListener("error", event => problems.push(event.message));
console.error = console.warn = (...said) => problems.push(said.join(" "));
window.addEventListener("load", async () => {
  const pause = time => new Promise(done => setTimeout(done, time));
  await pause(200);
  const replays = [];
  for (const button of [...document.querySelectorAll(".replays > nav button")].reverse()) {
    button.click();
    await pause(300);
    const shown = [...document.querySelectorAll("[data-replay]")].filter(frame => !frame.hidden), canvas = shown[0]?.querySelector("canvas");
    const pixels = canvas?.getContext("2d").getImageData(0, 0, canvas.width, canvas.height).data;
    replays.push({ name: shown.map(frame => frame.dataset.replay).join(), drawn: pixels ? pixels.filter((value, i) => i % 4 < 3 && value < 200).length : 0, text: shown[0]?.innerText ?? "" });
  }
  const wide = document.documentElement.clientWidth, about = element => `${element.tagName} ${element.className?.baseVal ?? element.className} '${(element.textContent ?? "").slice(0, 50)}'`;
  if (document.documentElement.scrollWidth > wide) problems.push(`the page is ${document.documentElement.scrollWidth} wide`);
  [...document.querySelectorAll("main *")].filter(element => !element.closest(".scroll") && !element.closest("[hidden]")).forEach(element => {
    const box = element.getBoundingClientRect();
    if (box.width && (box.right > wide + 1 || box.left < -1)) problems.push("runs off the page: " + about(element));
    if (element.scrollWidth > element.clientWidth + 1 && element.clientWidth && !element.closest("svg") && getComputedStyle(element).display !== "inline") problems.push("is cut: " + about(element));
  });
  const tables = [...document.querySelectorAll(".scroll")].filter(frame => frame.scrollWidth > frame.clientWidth + 1).map(frame => frame.dataset.table ?? frame.className);
  document.querySelectorAll("svg").forEach(picture => {
    const frame = picture.getBoundingClientRect(), boxes = [...picture.querySelectorAll("text")].map(text => ({ text: text.textContent, box: text.getBoundingClientRect() }));
    boxes.forEach(({ text, box }, i) => {
      if (box.left < frame.left - 1 || box.right > frame.right + 1 || box.top < frame.top - 1 || box.bottom > frame.bottom + 2) problems.push(`'${text}' leaves its drawing: ${picture.getAttribute("aria-label")}`);
      boxes.slice(0, i).forEach(other => {
        const across = Math.min(box.right, other.box.right) - Math.max(box.left, other.box.left), down = Math.min(box.bottom, other.box.bottom) - Math.max(box.top, other.box.top);
        if (across > 2 && down > 4) problems.push(`'${text}' lies on '${other.text}': ${picture.getAttribute("aria-label")}`);
      });
      if (/NaN|undefined|null/.test(text)) problems.push("nothing is written as " + text);
    });
    if (/NaN|undefined|Infinity/.test(picture.outerHTML)) problems.push("a drawing has no numbers: " + picture.getAttribute("aria-label"));
  });
  const words = document.querySelector("main").innerText;
  (words.match(/.*(NaN|undefined|null|\\[object).*/g) ?? []).forEach(line => problems.push("says " + line));
  const rows = {};
  document.querySelectorAll("[data-table]").forEach(frame => { rows[`${frame.closest("[data-test]")?.dataset.test ?? ""} ${frame.dataset.table}`.trim()] = frame.querySelectorAll("tr").length - 1; });
  const counted = selector => Object.fromEntries([...document.querySelectorAll("[data-test]")].map(place => [place.dataset.test, place.querySelectorAll(selector).length]));
  parent.postMessage(JSON.stringify({
    problems, rows, replays, tables, words, verdict: document.getElementById("verdict")?.textContent, arrows: counted("svg .force"), curves: counted("svg .curve"),
    small: Object.fromEntries([...document.querySelectorAll("[data-test]")].map(place => [place.dataset.test, place.querySelector(".mark").textContent])),
    first: document.querySelector(".first").offsetHeight, views: document.querySelectorAll(".views svg").length,
  }), "*");
});
</script>
"""
AROUND = """<!DOCTYPE html><body style="margin: 0"><iframe src="probed.html" style="border: 0; width: @WIDTH@px; height: 3000px"></iframe><script>
window.addEventListener("message", event => { const seen = document.createElement("div"); seen.id = "seen"; seen.textContent = event.data; document.body.appendChild(seen); });
</script>"""


def page_of(source, data):
    """As page::make: frame, chart library (not needed here), body, and data that cannot end their script."""
    coupler = source / "coupler"
    body = "".join(f"<script>\n{(coupler / script).read_text()}</script>\n" for script in SCRIPTS) + (coupler / "barrier/type_test.html").read_text()
    text = (coupler / "page/frame.html").read_text().replace("@TITLE@", "Type test", 1).replace("@BODY@", body, 1)
    return text.replace("@DATA@", json.dumps(data).replace("</", "<\\/"), 1).replace("@CHART_JS@", "const Chart = { instances: {}, defaults: {} };", 1)


def opened(source, data, width=SCREEN, paper=False):
    program = shutil.which("chromium") or shutil.which("chromium-browser")
    if not program:
        print("skipped: Chromium is not installed")
        sys.exit(77)
    text = page_of(source, data)
    assert not re.search(r'(src|href)\s*=\s*"(https?:)?//', text), "the page fetches something"
    if paper:
        text = text.replace("@media print", "@media all")
    with tempfile.TemporaryDirectory() as folder:
        pathlib.Path(folder, "probed.html").write_text(text.replace("<head>", "<head>" + PROBE, 1))
        around = pathlib.Path(folder, "around.html")
        around.write_text(AROUND.replace("@WIDTH@", str(width)))
        run = subprocess.run([program, "--headless", "--no-sandbox", "--use-angle=swiftshader", "--enable-unsafe-swiftshader", "--enable-logging=stderr", "--hide-scrollbars",
                              f"--user-data-dir={folder}/profile", "--virtual-time-budget=10000", "--window-size=1400,3000", "--dump-dom", around.as_uri()],
                             capture_output=True, text=True, timeout=150)
    errors = [line for line in run.stderr.splitlines() if "CONSOLE" in line]
    assert not errors, errors[:3]
    seen = re.search(r'<div id="seen">(.*?)</div>', run.stdout, re.S)
    assert seen, "the page did not load"
    return json.loads(seen.group(1).replace("&lt;", "<").replace("&gt;", ">").replace("&nbsp;", " ").replace("&amp;", "&"))


def emptied(value):
    """Every number and text null, every list and table of names as long as it is."""
    if isinstance(value, dict):
        return {key: inner if key in ("name", "part", "kind", "test", "finished") else emptied(inner) for key, inner in value.items()}
    if isinstance(value, list):
        return [emptied(inner) for inner in value]
    return None


def without_lists(value):
    if isinstance(value, dict):
        return {key: without_lists(inner) for key, inner in value.items()}
    return [] if isinstance(value, list) else value


class BarrierPage(unittest.TestCase):
    source = None

    @classmethod
    def setUpClass(cls):
        cls.data = json.loads((cls.source / "tests/program/barrier_report_sample.json").read_text())
        cls.screen = opened(cls.source, cls.data)

    def test_nothing_is_cut_on_a_screen_a_phone_and_paper(self):
        self.assertEqual((self.screen["problems"], self.screen["tables"]), ([], []))
        self.assertEqual(opened(self.source, self.data, PHONE)["problems"], [])
        paper = opened(self.source, self.data, PAPER, paper=True)
        self.assertEqual((paper["problems"], paper["tables"]), ([], []))
        self.assertLessEqual(paper["first"], PAPER_HEIGHT, "the first page is longer than a sheet of paper")

    def test_the_verdict_follows_from_the_rules(self):
        self.assertEqual(self.screen["verdict"], "not decided")
        self.assertEqual(self.screen["small"], {"sel_1": "passes", "sel_2": "not decided", "mel": "passes"})
        for passes, word in ((True, "passes"), (False, "fails")):
            data = copy.deepcopy(self.data)
            next(rule for rule in data["rules"] if rule["passes"] is None)["passes"] = passes
            seen = opened(self.source, data)
            self.assertEqual((seen["verdict"], seen["small"]["sel_2"]), (word, word))

    def test_a_broken_rule_outweighs_an_open_one(self):
        data = copy.deepcopy(self.data)
        data["rules"][0]["passes"] = False
        self.assertEqual(opened(self.source, data)["verdict"], "fails")

    def test_tables_have_a_row_for_each_thing(self):
        expected = {"rules": len(self.data["rules"]), "envelope": len(self.data["envelope"])}
        for test in self.data["tests"]:
            kinds = [entry["kind"] for entry in test["forces"]]
            counts = {"ropes": sum(kind not in ("post", "brake") for kind in kinds), "posts": kinds.count("post"), "brakes": len(test["brakes"]),
                      "anchors": len(test["anchors"]), "energy": len(test["energy"]["rows"]), "broken": len(test["broken"])}
            expected.update({f"{test['name']} {name}": count for name, count in counts.items() if count})
        self.assertEqual(self.screen["rows"], expected)

    def test_every_anchor_has_its_arrow_and_every_curve_its_line(self):
        self.assertEqual(self.screen["arrows"], {test["name"]: len(test["anchors"]) for test in self.data["tests"]})
        self.assertEqual(self.screen["curves"], {"sel_1": 6, "sel_2": 0, "mel": 6})
        self.assertEqual(self.screen["views"], 3)

    def test_the_choice_of_a_test_changes_the_replay(self):
        self.assertEqual([replay["name"] for replay in self.screen["replays"]], ["mel", "sel_2", "sel_1"])
        mel, sel_2, sel_1 = self.screen["replays"]
        self.assertGreater(mel["drawn"], 1000)
        self.assertGreater(sel_1["drawn"], 1000)
        self.assertNotEqual(mel["drawn"], sel_1["drawn"])
        self.assertIn("There is no replay of SEL 2", sel_2["text"])

    def test_what_is_null_is_said_not_to_be_measured(self):
        data = emptied({key: value for key, value in self.data.items() if key != "replays"})
        seen = opened(self.source, data, PHONE)
        self.assertEqual((seen["problems"], seen["verdict"]), ([], "not decided"))
        self.assertEqual(seen["rows"], self.screen["rows"])
        self.assertGreater(seen["words"].count("not measured"), 100)

    def test_what_is_empty_is_said_in_a_sentence(self):
        for data in (without_lists(self.data), {"title": "Nothing"}, {**self.data, "tests": [{"name": "mel"}]}, {**self.data, "tests": [without_lists(self.data["tests"][0])]}):
            seen = opened(self.source, data)
            self.assertEqual(seen["problems"], [])
            for heading in ("Rules", "The barrier", "Envelope over all tests", "Not covered", "How sure", "Default, verify", "Replay"):
                self.assertIn(heading, seen["words"])
            if data.get("tests"):
                for sentence in ("Forces in ropes and net: not measured.", "Forces in posts: not measured.", "Brakes: not measured.", "Forces on anchors: not measured.", "Energy: not measured."):
                    self.assertIn(sentence, seen["words"])


if __name__ == "__main__":
    BarrierPage.source = pathlib.Path(sys.argv.pop(1))
    if sys.argv[1:2] == ["--write"]:
        sample = json.loads((BarrierPage.source / "tests/program/barrier_report_sample.json").read_text())
        pathlib.Path(sys.argv[2]).write_text(page_of(BarrierPage.source, sample))
    else:
        unittest.main(verbosity=2)
