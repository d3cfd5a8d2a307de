#!/usr/bin/env python3
"""Opens a report in headless Chromium and uses it: report_in_browser.py NINEBIT_STUDY_TESTS

The test program leaves its example of a report in a folder. Exit status 77: there is no Chromium here.
"""
import base64
import json
import os
import select
import shutil
import subprocess
import sys
import tempfile
import time
import zlib

PATIENCE = 120  # seconds for any one answer: a busy machine starts a browser slowly


class Browser:
    """Chromium, spoken to by the DevTools protocol over a pipe: messages of JSON, each ended by a zero byte."""

    def __init__(self, program, profile):
        to_browser, self.out = os.pipe()
        self.inp, from_browser = os.pipe()
        # Chromium reads from 3 and writes to 4; the pipes' own numbers may be in the way, so a shell moves them.
        self.process = subprocess.Popen(
            ["bash", "-c", f'exec "$@" 3<&{to_browser} 4>&{from_browser}', "bash", program, "--headless=new",
             "--no-sandbox", "--disable-gpu", "--disable-dev-shm-usage", "--no-first-run", "--window-size=1200,900",
             "--remote-debugging-pipe", f"--user-data-dir={profile}", "about:blank"],
            pass_fds=(to_browser, from_browser), stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        os.close(to_browser)
        os.close(from_browser)
        self.rest = b""
        self.number = 0
        self.session = None
        self.events = []

    def message(self):
        end = time.monotonic() + PATIENCE
        while b"\0" not in self.rest:
            ready, _, _ = select.select([self.inp], [], [], max(0, end - time.monotonic()))
            piece = os.read(self.inp, 1 << 16) if ready else b""
            if not piece:
                raise SystemExit("report_in_browser: the browser " + ("ended" if ready else "does not answer"))
            self.rest += piece
        text, self.rest = self.rest.split(b"\0", 1)
        return json.loads(text)

    def call(self, method, **params):
        self.number += 1
        wanted = {"id": self.number, "method": method, "params": params}
        if self.session:
            wanted["sessionId"] = self.session
        os.write(self.out, json.dumps(wanted).encode() + b"\0")
        while True:
            message = self.message()
            if message.get("id") == self.number:
                if "error" in message:
                    raise SystemExit(f"report_in_browser: {method}: {message['error']}")
                return message["result"]
            self.events.append(message)

    def wait_for(self, method):
        while True:
            for event in self.events:
                if event.get("method") == method:
                    return
            self.events.append(self.message())

    def value(self, expression):
        answer = self.call("Runtime.evaluate", expression=expression, returnByValue=True, awaitPromise=True)
        if "exceptionDetails" in answer:
            raise SystemExit(f"report_in_browser: {expression}: {answer['exceptionDetails']}")
        return answer["result"].get("value")

    def move_to(self, x, y):
        self.call("Input.dispatchMouseEvent", type="mouseMoved", x=x, y=y)

    def click(self, x, y):
        for kind in ("mousePressed", "mouseReleased"):
            self.call("Input.dispatchMouseEvent", type=kind, x=x, y=y, button="left", clickCount=1)

    def press(self, key):
        for kind in ("keyDown", "keyUp"):
            self.call("Input.dispatchKeyEvent", type=kind, key=key, code=key)

    def box(self, selector):
        """Where an element is, once it is scrolled into view: x, y, width, height."""
        return self.value(f"""(() => {{
            const element = document.querySelector({json.dumps(selector)});
            element.scrollIntoView({{block: "center", behavior: "instant"}});
            const box = element.getBoundingClientRect();
            return [box.x, box.y, box.width, box.height];
        }})()""")

    def close(self):
        self.process.terminate()
        self.process.wait()


failures = []


def expect(truth, what):
    print(("ok: " if truth else "FAILED: ") + what)
    if not truth:
        failures.append(what)


# How many colours of what a canvas shows: a blank one has one.
COLOURS = """(canvas => {
    const data = canvas.getContext("2d").getImageData(0, 0, canvas.width, canvas.height).data;
    const seen = new Set();
    for (let i = 0; i < data.length; i += 4) seen.add(data.slice(i, i + 4).join());
    return seen.size;
})(document.querySelector(%s))"""


def column(number):
    return f"[...document.querySelectorAll('table.sorts tbody tr')].map(row => row.cells[{number}].dataset.v ?? " \
           f"row.cells[{number}].textContent)"


# A canvas's red, green and blue bytes in base64.
PIXELS = """(canvas => {
    const data = canvas.getContext("2d").getImageData(0, 0, canvas.width, canvas.height).data;
    return btoa(Array.from(data, (byte, i) => i %% 4 < 3 ? String.fromCharCode(byte) : "").join(""));
})(document.querySelector(%s))"""


def png_pixels(path):
    """The bytes of an RGB picture as this project writes it: 8 bits, and each row less the one above it."""
    with open(path, "rb") as file:
        png = file.read()
    width, at, packed = int.from_bytes(png[16:20], "big"), 8, b""
    while at < len(png):
        size, kind = int.from_bytes(png[at:at + 4], "big"), png[at + 4:at + 8]
        if kind == b"IDAT":
            packed += png[at + 8:at + 8 + size]
        at += size + 12
    rows, line, out = zlib.decompress(packed), 1 + 3 * width, []
    above = bytes(line - 1)
    for i in range(0, len(rows), line):
        if rows[i] != 2:
            raise ValueError(f"{path}: the filter of a row is {rows[i]}, not Up")
        above = bytes((a + b) & 255 for a, b in zip(rows[i + 1:i + line], above))
        out.append(above)
    return b"".join(out)


def check(browser, folder):
    url = f"file://{folder}/report.html"
    target = browser.call("Target.createTarget", url="about:blank")["targetId"]
    browser.session = browser.call("Target.attachToTarget", targetId=target, flatten=True)["sessionId"]
    for domain in ("Runtime", "Log", "Page", "Network"):
        browser.call(domain + ".enable")
    browser.call("Page.navigate", url=url)
    browser.wait_for("Page.loadEventFired")
    expect(browser.value("document.title") == "Index steps <example> – ninebit", "the page has its title")

    # Plots: there, and with a tooltip under the pointer.
    for selector in ("#plot-0", "#plot-1"):
        expect(browser.value(COLOURS % json.dumps(selector)) > 3, f"{selector} is drawn")
    x, y, width, height = browser.box("#plot-0")
    browser.move_to(x + 0.5 * width, y + 0.5 * height)
    tip = browser.value("new Promise(done => requestAnimationFrame(() => requestAnimationFrame(() => { const tip = "
                        "Chart.getChart('plot-0').tooltip; done([tip.opacity, tip.title ?? [], "
                        "(tip.body ?? []).map(b => b.lines)]); "
                        "})))")
    expect(tip[0] == 1 and tip[2] and "step: " in "".join(tip[1]), f"a plot tells the value under the pointer: {tip}")

    # Its legend hides a series and shows it again.
    shown = "[0, 1, 2].map(series => Chart.getChart('plot-0').isDatasetVisible(series)).join()"
    second = ".legend li:nth-child(2) button"
    for expected in ("true,false,true", "true,true,true"):
        x, y, width, height = browser.box(second)
        browser.click(x + width / 2, y + height / 2)
        expect(browser.value(shown) == expected, f"a click in the legend: {expected}")

    # Markup in a name is text.
    legend = browser.value("[...document.querySelectorAll('.legend')].pop().textContent")
    expect("<img src=x onerror=alert(1)>" in legend, f"a series with markup in its name is shown: {legend}")
    expect(browser.value("document.querySelectorAll('img[src=x], b b, header b').length") == 0, "and is not run")

    # Whole steps on an axis of steps; the plot is saved from the same description.
    ticks = browser.value("Chart.getChart('plot-0').scales.x.ticks.map(tick => tick.value)")
    expect(all(tick == int(tick) for tick in ticks) and len(ticks) > 3, f"steps are whole numbers: {ticks}")
    saved = browser.value("""new Promise(done => {
        HTMLAnchorElement.prototype.click = function () { done([this.download, this.href]); };
        document.querySelector(".save").click();
    })""")
    picture = base64.b64decode(saved[1].partition(",")[2])
    expect(saved[0] == "false-matches.png" and picture[:8] == b"\x89PNG\r\n\x1a\n" and len(picture) > 10000,
           f"a plot is saved as {saved[0]}, {len(picture)} bytes")
    expect(picture[16:24] == (1280).to_bytes(4, "big") + (800).to_bytes(4, "big"), "of 1280 x 800 pixels")

    # A heat map: drawn, and read by pointer and by keys. The pixel under the pointer is column 255 + 100, row 255 - 50.
    expect(browser.value(COLOURS % "'#map-0 .field canvas'") > 100, "a heat map is drawn")
    told = "document.querySelector('#map-0 output').textContent"
    before = browser.value(told)
    pixels = base64.b64decode(browser.value(PIXELS % "'#map-0 .field canvas'"))
    expect(pixels == png_pixels(f"{folder}/product-errors.png"), "a heat map has the pixels of its PNG file")
    x, y, width, height = browser.box("#map-0 canvas")
    browser.move_to(x + (355.5 / 511) * width, y + (205.5 / 511) * height)
    # trunc(100 * 50 / 255) - 100 * 50 / 255 = 19 - 19.6078…
    expect(browser.value(told) == "A 100, B 50: -0.607843", f"a heat map tells its value: {browser.value(told)}")
    expect(before != browser.value(told), "and did not before")
    browser.value("document.querySelector('#map-0 canvas').focus()")
    browser.press("ArrowLeft")
    browser.press("ArrowDown")
    expect(browser.value(told) == "A 99, B 49: -0.0235294", f"so do the arrow keys: {browser.value(told)}")
    browser.value("document.querySelector('#map-1 canvas').focus()")
    for _ in range(5):
        browser.press("ArrowRight")
    none = browser.value("document.querySelector('#map-1 output').textContent")
    expect(none == "step 6, difference 4: none", f"what has no value says so: {none}")

    # The table: cut at first, whole after a click; sorted as numbers, both ways; by the keyboard.
    rows = "[...document.querySelectorAll('table.sorts tbody tr')].filter(row => row.offsetHeight > 0).length"
    expect(browser.value(rows) == 40, "a long table is cut")
    x, y, width, height = browser.box("button.all")
    browser.click(x + width / 2, y + height / 2)
    expect(browser.value(rows) == 120, "and shown whole when asked")
    as_it_was = browser.value(column(2))
    x, y, width, height = browser.box("table.sorts th:nth-child(3) button")
    browser.click(x + width / 2, y + height / 2)
    rising = [int(n) for n in browser.value(column(2))]
    expect(rising == sorted(int(n) for n in as_it_was) and rising[0] < rising[-1], "a click sorts numbers as numbers")
    head = "document.querySelector('table.sorts th:nth-child(3)').getAttribute('aria-sort')"
    expect(browser.value(head) == "ascending", "and the head says so")
    browser.value("document.querySelector('table.sorts th:nth-child(3) button').focus()")
    browser.call("Input.dispatchKeyEvent", type="keyDown", key="Enter", code="Enter", windowsVirtualKeyCode=13,
                 text="\r")
    browser.call("Input.dispatchKeyEvent", type="keyUp", key="Enter", code="Enter", windowsVirtualKeyCode=13)
    falling = [int(n) for n in browser.value(column(2))]
    expect(falling == rising[::-1] and browser.value(head) == "descending", "the Enter key sorts the other way")

    # A phone: nothing but tables, which scroll by themselves, is wider than the screen.
    browser.call("Emulation.setDeviceMetricsOverride", width=390, height=800, deviceScaleFactor=2, mobile=True)
    browser.value("new Promise(done => requestAnimationFrame(() => requestAnimationFrame(done)))")
    wide = browser.value("document.documentElement.scrollWidth")
    expect(wide <= 390, f"the page fits a phone's screen: {wide} of 390 pixels")

    trouble = [e for e in browser.events if e.get("method") == "Runtime.exceptionThrown"
               or e.get("method") == "Log.entryAdded" and e["params"]["entry"]["level"] == "error"
               or e.get("method") == "Runtime.consoleAPICalled" and e["params"]["type"] in ("error", "warning")]
    expect(not trouble, f"the console has no error: {trouble}")
    asked = [e["params"]["request"]["url"] for e in browser.events if e.get("method") == "Network.requestWillBeSent"]
    foreign = [u for u in asked if not u.startswith("data:") and u != url]
    expect(asked and not foreign, f"nothing else is fetched: {foreign}")


def main():
    program = next(filter(None, map(shutil.which, ("chromium", "chromium-browser", "google-chrome"))), None)
    if program is None:
        print("skipped: there is no Chromium; ./dev packages browser installs it")
        return 77
    with tempfile.TemporaryDirectory(ignore_cleanup_errors=True) as folder:
        report = os.path.join(folder, "report")
        subprocess.run([sys.argv[1], "--gtest_filter=Report.LeavesTheExampleWhereAsked"], check=True,
                       stdout=subprocess.DEVNULL, env={**os.environ, "NINEBIT_REPORT_EXAMPLE": report})
        browser = Browser(program, os.path.join(folder, "profile"))
        try:
            check(browser, report)
        finally:
            browser.close()
    return 1 if failures else 0


if __name__ == "__main__":
    sys.exit(main())
