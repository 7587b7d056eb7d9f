"""A real browser for tests: Chromium, without a window, through its driver (WebDriver over HTTP). Needs nothing but Python."""

import base64
import json
import os
import re
import shutil
import subprocess
import tempfile
import time
import urllib.error
import urllib.request

PHONE_WIDTH = 390  # CSS pixels
SKIPPED = 77  # what ctest takes for a skipped test
ELEMENT = "element-6066-11e4-a52e-4f735466cecf"  # the key of elements in WebDriver's answers


def missing():
    """Why there is no browser here, or None."""
    for program in ("chromium", "chromedriver"):
        if not shutil.which(program):
            return f"{program} is not installed (./dev test --browser installs it)"
    return None


class Browser:
    """One page at a time. Used as `with Browser() as browser:`."""

    def __enter__(self):
        self.folder = tempfile.TemporaryDirectory()
        self.driver = subprocess.Popen(["chromedriver", "--port=0"], stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True)
        for line in self.driver.stdout:
            started = re.search(r"started successfully on port (\d+)", line)
            if started:
                break
        else:
            raise RuntimeError("chromedriver did not start")
        self.address = f"http://127.0.0.1:{started.group(1)}"
        options = {
            "args": ["--headless=new", "--no-sandbox", "--disable-gpu", "--disable-dev-shm-usage", "--window-size=1280,900",
                     f"--user-data-dir={self.folder.name}", "--host-resolver-rules=MAP * ~NOTFOUND"],
        }
        capabilities = {"alwaysMatch": {"browserName": "chrome", "goog:chromeOptions": options, "goog:loggingPrefs": {"browser": "ALL"}}}
        self.session = ""
        self.session = "/session/" + self.ask("POST", "/session", {"capabilities": capabilities})["sessionId"]
        return self

    def __exit__(self, *error):
        try:
            if self.session:
                self.ask("DELETE", "")
        finally:
            self.driver.terminate()
            self.driver.wait()
            self.driver.stdout.close()
            self.folder.cleanup()

    def ask(self, method, path, body=None):
        data = json.dumps(body).encode() if body is not None else None
        request = urllib.request.Request(self.address + self.session + path, data, {"Content-Type": "application/json"}, method=method)
        try:
            with urllib.request.urlopen(request, timeout=120) as answer:
                return json.load(answer)["value"]
        except urllib.error.HTTPError as error:
            raise RuntimeError(f"{method} {path}: {error.read().decode()[:2000]}") from None

    def open(self, path):
        self.ask("POST", "/url", {"url": "file://" + os.path.abspath(path)})
        self.wait("document.body.dataset.ready === 'yes'")

    def run(self, script, *arguments):
        """The value that `script`, the body of a function, returns."""
        return self.ask("POST", "/execute/sync", {"script": script, "args": list(arguments)})

    def wait(self, condition, seconds=60):
        end = time.monotonic() + seconds
        while not self.run(f"return Boolean({condition});"):
            if time.monotonic() > end:
                raise RuntimeError(f"not so after {seconds} s: {condition}; console: {self.console()}")
            time.sleep(0.05)

    def console(self):
        """What the console was told since the last call: warnings and errors."""
        return [entry["message"] for entry in self.ask("POST", "/se/log", {"type": "browser"}) if entry["level"] in ("WARNING", "SEVERE")]

    def find(self, selector):
        return self.ask("POST", "/element", {"using": "css selector", "value": selector})[ELEMENT]

    def click(self, selector):
        self.ask("POST", f"/element/{self.find(selector)}/click", {})

    def type(self, selector, keys):
        """Keys to an element; KEYS has those without a letter."""
        self.ask("POST", f"/element/{self.find(selector)}/value", {"text": keys})

    def hover(self, selector, x, y):
        """The mouse goes to pixel (x, y) of the element, counted from its upper left corner."""
        box = self.run("const b = document.querySelector(arguments[0]).getBoundingClientRect(); return [b.left, b.top];", selector)
        action = {"type": "pointerMove", "duration": 0, "origin": "viewport", "x": round(box[0] + x), "y": round(box[1] + y)}
        pointer = {"type": "pointer", "id": "mouse", "parameters": {"pointerType": "mouse"}, "actions": [action]}
        self.ask("POST", "/actions", {"actions": [pointer]})

    def emulate(self, command, parameters):
        self.ask("POST", "/goog/cdp/execute", {"cmd": "Emulation." + command, "params": parameters})

    def dark(self, on):
        self.emulate("setEmulatedMedia", {"features": [{"name": "prefers-color-scheme", "value": "dark" if on else "light"}]})

    def phone(self):
        self.emulate("setDeviceMetricsOverride", {"width": PHONE_WIDTH, "height": 844, "deviceScaleFactor": 2, "mobile": True})

    def screenshot(self, name):
        """Into the folder RAWTEXEL_SCREENSHOTS, where that is set."""
        folder = os.environ.get("RAWTEXEL_SCREENSHOTS")
        if folder:
            with open(os.path.join(folder, name + ".png"), "wb") as file:
                file.write(base64.b64decode(self.ask("GET", "/screenshot")))


KEYS = {"left": "\ue012", "right": "\ue014", "home": "\ue011", "end": "\ue010", "tab": "\ue004"}


def luminance(colour):
    """0 to 1 of what getComputedStyle gives."""
    red, green, blue = (float(part) for part in re.findall(r"[\d.]+", colour)[:3])
    return (0.2126 * red + 0.7152 * green + 0.0722 * blue) / 255
