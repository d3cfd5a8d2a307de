#!/usr/bin/env python3
"""Opens pages of `ninebit trace -o` and `ninebit explain -o` in headless Chromium: diagram_in_browser.py NINEBIT SOURCE_DIR

Exit status 77: there is no Chromium here.
"""
import os
import shutil
import subprocess
import sys
import tempfile

sys.dont_write_bytecode = True
sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "study"))
import report_in_browser  # noqa: E402
from report_in_browser import Browser, expect  # noqa: E402

FRAME = "new Promise(done => requestAnimationFrame(() => requestAnimationFrame(done)))"
STEP = "document.querySelector('.nb-step').textContent"
SAID = "document.querySelector('.nb-said').textContent"
COUNT = "document.querySelectorAll(%r).length"


def open_page(browser, path):
    target = browser.call("Target.createTarget", url="about:blank")["targetId"]
    browser.session = browser.call("Target.attachToTarget", targetId=target, flatten=True)["sessionId"]
    browser.events = []
    for domain in ("Runtime", "Log", "Page", "Network"):
        browser.call(domain + ".enable")
    browser.call("Page.navigate", url="file://" + path)
    browser.wait_for("Page.loadEventFired")


def check_quiet(browser, path):
    trouble = [e for e in browser.events if e.get("method") == "Runtime.exceptionThrown"
               or e.get("method") == "Log.entryAdded" and e["params"]["entry"]["level"] == "error"
               or e.get("method") == "Runtime.consoleAPICalled" and e["params"]["type"] in ("error", "warning")]
    expect(not trouble, f"the console has no error: {trouble}")
    asked = [e["params"]["request"]["url"] for e in browser.events if e.get("method") == "Network.requestWillBeSent"]
    foreign = [u for u in asked if not u.startswith("data:") and u != "file://" + path]
    expect(asked and not foreign, f"nothing else is fetched: {foreign}")


def check_colors_and_phone(browser):
    paper = "getComputedStyle(document.querySelector('.nb-diagram')).backgroundColor"
    seen = []
    for scheme in ("light", "dark"):
        browser.call("Emulation.setEmulatedMedia", features=[{"name": "prefers-color-scheme", "value": scheme}])
        seen.append(browser.value(paper))
    expect(seen[0] != seen[1], f"light and dark: {seen}")
    for width in (360, 390):
        browser.call("Emulation.setDeviceMetricsOverride", width=width, height=800, deviceScaleFactor=2, mobile=True)
        browser.value(FRAME)
        wide = browser.value("document.documentElement.scrollWidth")
        expect(wide <= width, f"the page fits a phone's screen: {wide} of {width} pixels")
    scrolls = "(box => box.scrollWidth > box.clientWidth)(document.querySelector('.nb-scroll'))"
    expect(browser.value(scrolls), "the diagram scrolls inside its box")


def check_trace(browser, path):
    open_page(browser, path)
    expect(browser.value("document.querySelector('h1').textContent").endswith("<img src=x onerror=hit=1>.gl"),
           "a hostile name is shown")
    expect(browser.value("typeof hit") == "undefined" and browser.value(COUNT % "img") == 0, "and not run")
    boxes, wires = browser.value(COUNT % ".nb-box"), browser.value(COUNT % ".nb-wires path:not(.nb-hold)")
    expect(boxes == 19 and wires == 18, f"boxes and wires: {boxes}, {wires}")
    expect(browser.value(COUNT % ".nb-cell.nb-clamped") == 5 and browser.value(COUNT % ".nb-cell.nb-truncated") == 3,
           "what was clamped and truncated is marked")

    # The value under the pointer: what it was computed from is lit, and the rest fades.
    browser.value("document.querySelectorAll('.nb-result')[1].querySelector('.nb-cell').id = 'last'")
    x, y, width, height = browser.box("#last")
    browser.move_to(x + width / 2, y + height / 2)
    browser.value(FRAME)
    expect(browser.value(COUNT % ".nb-box.nb-lit") == 18, "all boxes but the colour's result are lit")
    browser.value("new Promise(done => setTimeout(done, 300))")
    faded = "getComputedStyle(document.querySelectorAll('.nb-result')[0]).opacity"
    expect(float(browser.value(faded)) < 0.5, "which fades")
    expect("255/255" in browser.value(SAID), f"the value is told: {browser.value(SAID)}")

    # Steps, by keys.
    browser.value("document.querySelector('.nb-scroll').focus()")
    steps = browser.value(STEP)
    browser.press("ArrowRight")
    browser.press("ArrowRight")
    expect(browser.value(STEP).startswith("step 2 of "), f"two steps: {browser.value(STEP)}")
    expect(browser.value(COUNT % ".nb-box.nb-pending") == boxes - 3, "later units are not there yet")
    browser.press("ArrowLeft")
    expect(browser.value(STEP).startswith("step 1 of "), "a step back")
    browser.press("Escape")
    expect(browser.value(STEP) == steps and browser.value(COUNT % ".nb-pending") == 0, "Escape shows all")
    browser.press("ArrowDown")
    label = browser.value("document.activeElement.getAttribute('aria-label')")
    expect(label == "primary, of the fragment, red: code 10/255, real 0.03922, ideal 0.03922", f"the first value: {label}")
    x, y, width, height = browser.box("[aria-label^='Step forward']")
    browser.click(x + width / 2, y + height / 2)
    expect(browser.value(STEP).startswith("step 1 of "), "the button steps")
    check_colors_and_phone(browser)
    check_quiet(browser, path)


def check_passes(browser, path):
    """The page of a pixel goes from pass to pass."""
    open_page(browser, path)
    tab = "document.querySelector('.passes [aria-selected=true]')"
    tabs, first = browser.value(COUNT % ".passes button"), browser.value(tab + ".textContent")
    expect(tabs == 4 and first == "4. shadow", f"the deciding pass of {tabs} is shown: {first}")
    boxes = browser.value(COUNT % ".nb-box")
    browser.value(tab + ".focus()")
    browser.press("ArrowLeft")
    expect(browser.value(tab + ".textContent") == "3. lit" and browser.value(COUNT % ".nb-box") == 0,
           "a pass without a program has no diagram")
    expect(browser.value("document.querySelector('#pass .note').textContent").startswith("No program"), "and says so")
    browser.press("ArrowLeft")
    compared = browser.value(COUNT % ".nb-box")
    expect(browser.value(tab + ".textContent") == "2. comparison" and compared not in (0, boxes),
           "an arrow key shows another pass with its own program")
    x, y, width, height = browser.box(".passes button:nth-child(4)")
    browser.click(x + width / 2, y + height / 2)
    expect(browser.value(COUNT % ".nb-box") == boxes, "a click shows the first one again")
    check_colors_and_phone(browser)
    check_quiet(browser, path)


def check_explanation(browser, path):
    open_page(browser, path)
    boxes, equations = browser.value(COUNT % ".nb-box"), browser.value(COUNT % ".nb-equation")
    expect(boxes == 19 and equations == 4, f"boxes and equations: {boxes}, {equations}")
    first = browser.value("document.querySelector('.nb-equation').textContent")
    expect(first == "spare0 = 4·(primary − tex0)", f"an equation: {first}")
    check_colors_and_phone(browser)
    check_quiet(browser, path)


def main():
    program = next(filter(None, map(shutil.which, ("chromium", "chromium-browser", "google-chrome"))), None)
    if program is None:
        print("skipped: there is no Chromium; ./dev packages browser installs it")
        return 77
    ninebit, source = sys.argv[1:]
    with tempfile.TemporaryDirectory(ignore_cleanup_errors=True) as folder:
        article = os.path.join(folder, "<img src=x onerror=hit=1>.gl")
        shutil.copy(os.path.join(source, "docs/programs/index_compare.gl"), article)
        trace, explanation, passes = (os.path.join(folder, name) for name in ("trace.html", "explain.html", "passes.html"))
        subprocess.run([ninebit, "trace", article, "--set", "primary=10,20,30,255", "--set", "tex0=50,100,150,255", "-o",
                        trace, "--quiet"], check=True)
        subprocess.run([ninebit, "explain", article, "-o", explanation, "--quiet"], check=True)
        subprocess.run([ninebit, "trace", "--effect", os.path.join(source, "scenes/effects/index_cube.json"), "--pixel",
                        "300,240", "-o", passes, "--quiet"], check=True)
        browser = Browser(program, os.path.join(folder, "profile"))
        try:
            check_trace(browser, trace)
            browser.session = None
            check_explanation(browser, explanation)
            browser.session = None
            check_passes(browser, passes)
        finally:
            browser.close()
    return 1 if report_in_browser.failures else 0


if __name__ == "__main__":
    sys.exit(main())
