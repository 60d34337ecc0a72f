"""A headless Chromium, driven by chromedriver over HTTP: no library needed."""
import base64
import json
import pathlib
import subprocess
import time
import urllib.request


class Browser:
    def __init__(self):
        self.driver = subprocess.Popen(["chromedriver", "--port=9597"], stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        options = {"args": ["--headless=new", "--no-sandbox", "--disable-gpu", "--hide-scrollbars"]}
        wanted = {"alwaysMatch": {"browserName": "chrome", "goog:chromeOptions": options, "goog:loggingPrefs": {"browser": "ALL"}}}
        self.base = "http://127.0.0.1:9597"
        for attempt in range(100):
            try:
                self.session = self.post("/session", {"capabilities": wanted})["sessionId"]
                break
            except OSError:
                time.sleep(0.1)
        else:
            raise RuntimeError("chromedriver does not answer")
        self.base += f"/session/{self.session}"

    def post(self, path, body):
        request = urllib.request.Request(self.base + path, json.dumps(body).encode(), {"Content-Type": "application/json"})
        return json.load(urllib.request.urlopen(request, timeout=60))["value"]

    def close(self):
        try:
            urllib.request.urlopen(urllib.request.Request(self.base, method="DELETE"), timeout=20)
        finally:
            self.driver.terminate()
            self.driver.wait()

    def open(self, path):
        self.post("/url", {"url": pathlib.Path(path).resolve().as_uri()})

    def run(self, script, *arguments):
        return self.post("/execute/sync", {"script": script, "args": list(arguments)})

    def wait_for(self, script):
        return self.post("/execute/async", {"script": script, "args": []})

    def console(self):
        return [entry["message"] for entry in self.post("/se/log", {"type": "browser"})]

    def devtools(self, command, **parameters):
        return self.post("/goog/cdp/execute", {"cmd": command, "params": parameters})

    def costs(self):
        """Seconds of processor time since the page was opened: ScriptDuration, LayoutDuration, TaskDuration and others."""
        self.devtools("Performance.enable", timeDomain="threadTicks")
        return {item["name"]: item["value"] for item in self.devtools("Performance.getMetrics")["metrics"]
                if item["name"].endswith("Duration")}

    def look(self, scheme="light", width=1200, height=900, media=""):
        self.devtools("Emulation.setEmulatedMedia", media=media, features=[{"name": "prefers-color-scheme", "value": scheme}])
        self.devtools("Emulation.setDeviceMetricsOverride", width=width, height=height, deviceScaleFactor=1, mobile=False)

    def key(self, key):
        codes = {"ArrowRight": "\ue014", "ArrowLeft": "\ue012", "Home": "\ue011", "End": "\ue010", " ": " "}
        actions = [{"type": kind, "value": codes[key]} for kind in ("keyDown", "keyUp")]
        self.post("/actions", {"actions": [{"type": "key", "id": "keys", "actions": actions}]})

    def click(self, selector):
        element = next(iter(self.post("/element", {"using": "css selector", "value": selector}).values()))
        self.post(f"/element/{element}/click", {})

    def screenshot(self, path, whole=False):
        """What the window shows, or the whole page."""
        parameters = {"format": "png"}
        if whole:
            size = self.devtools("Page.getLayoutMetrics")["cssContentSize"]
            clip = {"x": 0, "y": 0, "width": size["width"], "height": min(size["height"], 8000), "scale": 1}
            parameters |= {"captureBeyondViewport": True, "clip": clip}
        pathlib.Path(path).write_bytes(base64.b64decode(self.devtools("Page.captureScreenshot", **parameters)["data"]))
