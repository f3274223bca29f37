"""Debian's Chromium without a screen, driven by its chromedriver through Debian's selenium.

What the page is asked goes through the debugger, which the page's own policy does not bind: the policy is tested as it ships.
"""

import json
import os
import shutil
import tempfile
import time

from selenium import webdriver
from selenium.common.exceptions import ElementClickInterceptedException, ElementNotInteractableException, JavascriptException, NoSuchElementException, StaleElementReferenceException
from selenium.webdriver.chrome.service import Service
from selenium.webdriver.common.action_chains import ActionChains

START_S = 60.0  # a browser comes up within this, on a machine that builds beside it
LOOK_S = 0.05  # pause between two looks at a condition
POINTER_S = 30.0
# The page puts nodes up and takes them down while it is looked at: what is gone is looked for again.
# What another thing lies over is touched again: where it stays there, "last gone" names it.
GONE_MEANWHILE = (ElementClickInterceptedException, ElementNotInteractableException, JavascriptException, NoSuchElementException, StaleElementReferenceException)


class Browser:
    """One browser with a profile of its own. Ends with close(), also when its test fails."""

    def __init__(self, size=(1280, 800), languages="en", dark=False, trusts_everybody=False):
        self.folder = tempfile.mkdtemp(prefix="axiscal-browser-")
        options = webdriver.ChromeOptions()
        options.binary_location = shutil.which("chromium")
        # No sandbox: root has none, and containers have none for others; the page under test is our own.
        for word in ["--headless=new", "--no-sandbox", "--disable-gpu", "--disable-dev-shm-usage", "--no-first-run", "--hide-scrollbars",
                     "--disable-background-networking", "--disable-audio-output", "--disable-component-update", "--disable-sync", "--js-flags=--expose-gc",
                     f"--lang={languages.split(',')[0]}", f"--accept-lang={languages}", f"--user-data-dir={self.folder}/profile"]:
            options.add_argument(word)
        if dark:
            options.add_argument("--force-dark-mode")
        options.accept_insecure_certs = trusts_everybody  # of TLS
        options.set_capability("goog:loggingPrefs", {"browser": "ALL"})
        service = Service(shutil.which("chromedriver"), log_path=f"{self.folder}/driver.log",
                          env={**os.environ, "HOME": self.folder, "XDG_CONFIG_HOME": self.folder, "XDG_CACHE_HOME": self.folder})
        try:
            self.driver = webdriver.Chrome(service=service, options=options)
        except BaseException:
            shutil.rmtree(self.folder, ignore_errors=True)
            raise
        self.driver.set_page_load_timeout(START_S)
        self.driver.set_script_timeout(START_S)
        self.resize(size)

    def __enter__(self):
        return self

    def __exit__(self, *_):
        self.close()

    def close(self):
        try:
            self.driver.quit()
        finally:
            shutil.rmtree(self.folder, ignore_errors=True)

    def resize(self, size):
        """Of what the page sees, whatever frame the window has."""
        self.tell("Emulation.setDeviceMetricsOverride", width=size[0], height=size[1], deviceScaleFactor=1, mobile=False)

    def tell(self, command, **words):
        """A command of the DevTools protocol."""
        return self.driver.execute_cdp_cmd(command, words)

    def open(self, address):
        self.driver.get(address)

    def ask(self, expression):
        """The value of a JavaScript expression in the page."""
        return self.driver.execute_script(f"return ({expression});")

    def evaluate(self, expression):
        """The same, awaited where it is a promise, and without what the driver runs in the page for ask(): it needs nothing of a browser."""
        answer = self.tell("Runtime.evaluate", expression=expression, awaitPromise=True, returnByValue=True)
        if "exceptionDetails" in answer:
            raise AssertionError(f"{expression[:200]}: {answer['exceptionDetails']}")
        return answer["result"].get("value")

    def text(self, selector):
        """What is seen of an element, one line; empty where it is not shown."""
        # innerText of what is not rendered is its textContent.
        return self.ask(f"((one) => one?.checkVisibility() ? one.innerText.replace(/\\s+/g, ' ').trim() : '')(document.querySelector({json.dumps(selector)}))")

    def wait(self, what, probe, limit_s=30.0):
        end = time.monotonic() + limit_s
        gone = ""
        while True:
            try:
                found = probe()
            except GONE_MEANWHILE as error:
                found, gone = None, f"; last gone: {error.msg}"
            if found:
                return found
            if time.monotonic() > end:
                raise AssertionError(f"after {limit_s:g} s still not: {what}{gone}; the page shows: {self.text('body')}")
            time.sleep(LOOK_S)

    def wait_for_text(self, selector, words, limit_s=30.0):
        return self.wait(f"{selector} shows {words!r}", lambda: words in self.text(selector), limit_s)

    def element(self, selector):
        return self.driver.find_element("css selector", selector)

    def click(self, selector):
        """As a finger does: the page may put another node in its place meanwhile."""
        self.wait(f"{selector} can be touched", lambda: self.element(selector).click() or True, POINTER_S)

    def hold(self, selector, seconds):
        ActionChains(self.driver).click_and_hold(self.element(selector)).pause(seconds).release().perform()

    def hold_key(self, key, seconds):
        ActionChains(self.driver).key_down(key).pause(seconds).key_up(key).perform()

    def processes(self):
        """The browser's own, not its driver."""
        found = []
        for folder in os.listdir("/proc"):
            try:
                with open(f"/proc/{folder}/cmdline", "rb") as file:
                    words = file.read()
            except OSError:
                continue  # no process, or gone meanwhile
            if folder.isdigit() and f"--user-data-dir={self.folder}/".encode() in words and b"chromedriver" not in words.split(b"\0")[0]:
                found.append(int(folder))
        return found

    def keys(self, *keys):
        ActionChains(self.driver).send_keys(*keys).perform()

    def complaints(self):
        """Warnings and errors of the console since it was asked last."""
        return [f"{line['level']}: {line['message']}" for line in self.driver.get_log("browser") if line["level"] in ("WARNING", "SEVERE")]

    def picture(self, file):
        self.driver.save_screenshot(str(file))
