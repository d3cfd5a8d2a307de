"""Pages in a notebook's frame, in headless Chromium: they are as high as they are, pictures come first, downloads work."""
import pathlib
import shutil
import sys
import tempfile
import time
import unittest

import ninebit

top = pathlib.Path(__file__).resolve().parents[2]
sys.path.insert(0, str(top / "combiner_tests/study"))
from report_in_browser import Browser  # noqa: E402  pylint: disable=wrong-import-position

PATIENCE = 60  # seconds
chromium = shutil.which("chromium") or shutil.which("chromium-browser") or shutil.which("google-chrome")


@unittest.skipUnless(chromium, "Chromium is not installed")
class Notebook(unittest.TestCase):
    def setUp(self):
        self.folder = tempfile.TemporaryDirectory(ignore_cleanup_errors=True)  # Chromium ends a moment later
        self.addCleanup(self.folder.cleanup)
        self.browser = Browser(chromium, self.folder.name + "/profile")
        self.addCleanup(self.browser.process.wait)
        self.addCleanup(self.browser.process.kill)
        target = self.browser.call("Target.createTarget", url="about:blank")["targetId"]
        self.browser.session = self.browser.call("Target.attachToTarget", targetId=target, flatten=True)["sessionId"]

    def show(self, name, html):
        """Opens a notebook with one cell."""
        file = pathlib.Path(self.folder.name) / f"{name}.html"
        file.write_text(f"<!doctype html><body>{html}</body>")
        self.browser.call("Page.navigate", url=file.as_uri())

    def until(self, wanted, what):
        end = time.monotonic() + PATIENCE
        while time.monotonic() < end:
            value = wanted()
            if value:
                return value
            time.sleep(0.1)
        return self.fail(what)

    def height(self):
        return float(self.browser.value("parseFloat(document.querySelector('iframe')?.style.height ?? 0)") or 0)

    def test_a_page_is_as_high_as_its_content(self):
        program = ninebit.Program("!!RC1.0\nout.rgb = tex0;")
        compared = ninebit.compare(top / "scenes/index_room.gltf", size=(64, 48), map_size=32, vary={"index_step": [1, 2]})
        for name, answer in (("trace", program.trace(tex0=3)), ("compare", compared)):
            self.show(name, answer._repr_html_())
            self.until(lambda: self.height() not in (0, 560) and self.height() > 150, f"{name}: {self.height()}")
        self.assertIn("main > header", compared._repr_html_().replace("&gt;", ">"))

    def test_downloads_work(self):
        report = ninebit.study("index-steps", profile="geforce2", formats="channel", steps="1-4")
        click = "<script>setTimeout(() => document.querySelector('button.save').click(), 500)</script>"
        report._page = report._page.replace("</body>", click + "</body>")
        files = pathlib.Path(self.folder.name) / "files"
        self.browser.call("Page.setDownloadBehavior", behavior="allow", downloadPath=str(files))
        self.show("study", report._repr_html_())
        self.until(lambda: list(files.glob("*.png")), "no file was saved")


if __name__ == "__main__":
    unittest.main()
