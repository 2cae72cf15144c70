"""Opens the replay of a report in headless Chromium and looks at what it draws: two frames differ as the rock of the result moved between them,
the slider and the play button move the picture, the views, the colours and the mouse change it.

check_replay.py RESULT, a folder with report.html and one rock that is larger than all others. Ends with 77 (skipped) where Chromium is not installed.
"""
import base64
import io
import json
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile
import unittest

import h5py
import numpy as np
from PIL import Image
from scipy import ndimage

# Runs the steps one after the other, each followed by a copy of the picture. A browser without a window shows no frames: a timer asks for them.
PROBE = """
<script>
window.requestAnimationFrame = act => setTimeout(() => act(performance.now()), 16);
window.addEventListener("load", async () => {
  const pause = time => new Promise(done => setTimeout(done, time));
  const canvas = document.querySelector(".replay canvas"), pictures = [], times = [], buttons = [...document.querySelectorAll(".replay button")];
  const press = text => buttons.find(button => button.textContent.includes(text)).click();
  const slider = document.querySelector(".replay input"), slide = value => { slider.value = value; slider.dispatchEvent(new Event("input")); };
  const drag = (x, y) => ["pointerdown", "pointermove", "pointerup"].forEach((name, i) =>
    canvas.dispatchEvent(new PointerEvent(name, { pointerId: 1, clientX: 100 + (i ? x : 0), clientY: 100 + (i ? y : 0) })));
  const colour = name => { const select = document.querySelectorAll(".replay select")[1]; select.value = name; select.dispatchEvent(new Event("change")); };
  const steps = [@STEPS@];
  for (const step of canvas ? steps : []) {
    step();
    await pause(400);
    pictures.push(canvas.toDataURL("image/png"));
    times.push(Number(slider.value));
  }
  const seen = document.createElement("div");
  seen.id = "seen";
  seen.textContent = JSON.stringify({ pictures, times, text: document.body.innerText.slice(0, 3000) });
  document.body.appendChild(seen);
});
</script>
"""


def opened(page, steps):
    """The pictures and times after each step, and what else the page says."""
    program = shutil.which("chromium") or shutil.which("chromium-browser")
    if not program:
        print("skipped: Chromium is not installed")
        sys.exit(77)
    with tempfile.TemporaryDirectory() as folder:
        probed = pathlib.Path(folder, "probed.html")
        text = page.read_text()
        probed.write_text(text.replace("<head>", "<head>" + PROBE.replace("@STEPS@", ", ".join(f"() => {{ {step} }}" for step in steps)), 1))
        run = subprocess.run([program, "--headless", "--no-sandbox", "--use-angle=swiftshader", "--enable-unsafe-swiftshader", "--enable-logging=stderr",
                              f"--user-data-dir={folder}/profile", "--virtual-time-budget=10000", "--window-size=900,1200", "--dump-dom",
                              probed.as_uri()], capture_output=True, text=True, timeout=150)
    errors = [line for line in run.stderr.splitlines() if "CONSOLE" in line]
    assert not errors, errors
    seen = re.search(r'<div id="seen">(.*?)</div>', run.stdout, re.S)
    assert seen, "the page did not load"
    seen = json.loads(seen.group(1).replace("&lt;", "<").replace("&gt;", ">").replace("&amp;", "&"))
    seen["pictures"] = [np.asarray(Image.open(io.BytesIO(base64.b64decode(picture.split(",")[1]))).convert("RGB")).astype(int) for picture in seen["pictures"]]
    return seen


def middle(picture):
    """Without the edges, where time, legend and axes are written."""
    height, width, _ = picture.shape
    return picture[height // 5: -height // 5, width // 5: -width // 5]


def changed(a, b):
    return np.count_nonzero(np.abs(middle(a) - middle(b)).max(axis=2) > 40)


def rock(picture):
    """Middle (x to the right, y up) and diameter in pixels of the largest brown spot."""
    spots, count = ndimage.label(picture[:, :, 0] - picture[:, :, 2] > 12)
    assert count, "no rock is in the picture"
    largest = 1 + np.argmax(ndimage.sum_labels(np.ones_like(spots), spots, range(1, count + 1)))
    rows, columns = np.nonzero(spots == largest)
    return np.array([(columns.min() + columns.max()) / 2, -(rows.min() + rows.max()) / 2]), columns.max() - columns.min() + 1


class Replay(unittest.TestCase):
    folder = None

    @classmethod
    def setUpClass(cls):
        with h5py.File(cls.folder / "fields.h5") as fields:
            cls.frames = int(fields["frames_written"][0])
            cls.times = fields["time"][: cls.frames]
            cls.radii = fields["particles/radius/000000"][:, 0]
            cls.places = np.array([fields[f"particles/position/{frame:06d}"][:] for frame in range(cls.frames)])[:, cls.radii.argmax()]
        middle_frame, end = cls.frames // 2, cls.times[-1]
        cls.steps = {
            "opened": "", "first": "location.hash = 'frame=0&view=side'", "last": f"location.hash = 'frame={cls.frames - 1}&view=side'",
            "start": "press('front'); slide(0)", "later": f"slide({0.4 * end})", "little later": f"slide({0.41 * end})", "start again": "slide(0)", "played": "press('Play')",
            "front": f"location.hash = 'frame={middle_frame}&view=front'", "side": "press('side')", "top": "press('top')", "reset": "press('reset')",
            "dragged": "drag(60, 0)", "force": "press('reset'); colour('axial force')", "displacement": "colour('displacement')",
            "net hidden": "colour('part'); press('net')", "net shown": "press('net')"}
        seen = opened(cls.folder / "report.html", cls.steps.values())
        cls.text = seen["text"]
        assert seen["pictures"], "there is no replay: " + cls.text
        cls.pictures, cls.clock = dict(zip(cls.steps, seen["pictures"])), dict(zip(cls.steps, seen["times"]))

    def assertChanged(self, a, b, least=300):
        self.assertGreater(changed(self.pictures[a], self.pictures[b]), least, f"from '{a}' to '{b}' the picture stays as it is")

    def test_the_rock_is_drawn_where_the_result_says(self):
        """Seen from the side, up against gravity; lengths in diameters of the rock, since the picture's own scale is not known here."""
        facts = json.loads((self.folder / "summary.json").read_text())["facts"]
        down = np.array([facts[f"particles.gravity_{axis}_m_per_s2"] for axis in "xyz"])
        up = -down / np.linalg.norm(down)
        right = np.cross(up, [1, 0, 0])
        self.assertEqual(self.clock["first"], 0)
        self.assertAlmostEqual(self.clock["last"], self.times[-1])
        (start, size), (end, same_size) = rock(self.pictures["first"]), rock(self.pictures["last"])
        self.assertLessEqual(abs(size - same_size), 2)
        way = (self.places[-1] - self.places[0]) / (2 * self.radii.max())
        np.testing.assert_allclose((end - start) / size, [way @ right, way @ up], atol=2.5 / size + 0.03 * np.linalg.norm(way))

    def test_the_slider_moves_the_picture(self):
        self.assertGreater(np.count_nonzero(middle(self.pictures["start"]).min(axis=2) < 200), 2000, "the picture is empty")
        self.assertChanged("start", "later")
        self.assertChanged("later", "little later", 0)
        self.assertEqual(changed(self.pictures["start"], self.pictures["start again"]), 0)

    def test_playing_goes_on_in_slow_motion(self):
        self.assertGreater(self.clock["played"], 0)
        self.assertLess(self.clock["played"], 0.2 * self.times[-1])

    def test_views_colours_parts_and_the_mouse_change_the_picture(self):
        names = list(self.steps)[list(self.steps).index("front"):]
        for before, after in zip(names, names[1:]):
            self.assertChanged(before, after)
        self.assertEqual(changed(self.pictures["reset"], self.pictures["net shown"]), 0)

    def test_the_page_says_what_is_shown(self):
        self.assertIn(f"all {self.frames} frames of the result", self.text)


if __name__ == "__main__":
    Replay.folder = pathlib.Path(sys.argv.pop(1))
    unittest.main(verbosity=2)
