//! A headless Chromium, driven by the DevTools protocol over a pair of pipes: no port, no server.

use serde_json::{Value, json};
use std::fs::File;
use std::io::{BufRead as _, BufReader, Write as _};
use std::path::Path;
use std::process::{Child, Command, Stdio};
use std::time::{Duration, Instant};
use tempfile::TempDir;

/// A page in a browser of its own.
pub(crate) struct Browser {
    child: Child,
    to: File,
    from: BufReader<File>,
    calls: u64,
    session: Option<String>,
    /// What the page said and asked for while nobody waited for it.
    pub(crate) events: Vec<Value>,
    _profile: TempDir,
}

const NAMES: [&str; 3] = ["chromium", "chromium-browser", "google-chrome"];

/// The browser of `UMBRAGE_BROWSER`, or the first that is there.
fn program() -> String {
    let runs = |name: &String| {
        let probe = Command::new(name).arg("--version").stdout(Stdio::null()).stderr(Stdio::null()).status();
        probe.is_ok_and(|s| s.success())
    };
    let named = std::env::var("UMBRAGE_BROWSER").ok();
    let found = named.into_iter().chain(NAMES.map(String::from)).find(runs);
    found.expect("no browser: install one (`apt-get install chromium`; `cargo xtask page` does), or name it in UMBRAGE_BROWSER")
}

impl Browser {
    /// Opens a page from the disk, and waits until it has loaded.
    pub(crate) fn open(page: &Path, (width, height): (u32, u32)) -> Self {
        let profile = tempfile::tempdir().expect("a temporary folder");
        let pipes = ["to", "from"].map(|name| profile.path().join(name));
        let made = Command::new("mkfifo").args(&pipes).status();
        assert!(made.is_ok_and(|s| s.success()), "mkfifo");
        // Chromium reads from descriptor 3 and writes to 4; the shell opens them.
        let child = Command::new("sh")
            .arg("-c")
            .arg("exec \"$0\" --headless=new --no-sandbox --disable-gpu --hide-scrollbars --remote-debugging-pipe --user-data-dir=\"$1\" about:blank 3<\"$2\" 4>\"$3\"")
            .arg(program())
            .arg(profile.path().join("profile"))
            .args(&pipes)
            .stdout(Stdio::null())
            .stderr(Stdio::null())
            .spawn()
            .expect("a shell");
        let to = File::options().write(true).open(&pipes[0]).expect("the pipe to the browser");
        let from = BufReader::new(File::open(&pipes[1]).expect("the pipe from the browser"));
        let mut browser =
            Self { child, to, from, calls: 0, session: None, events: vec![], _profile: profile };
        let target = browser.call("Target.createTarget", json!({ "url": "about:blank" }));
        let attach = json!({ "targetId": target["targetId"], "flatten": true });
        let session = browser.call("Target.attachToTarget", attach);
        browser.session = session["sessionId"].as_str().map(String::from);
        for domain in ["Page", "Runtime", "Log", "Network"] {
            browser.call(&format!("{domain}.enable"), json!({}));
        }
        let screen = json!({ "width": width, "height": height, "deviceScaleFactor": 1, "mobile": false });
        browser.call("Emulation.setDeviceMetricsOverride", screen);
        let url = format!("file://{}", page.display());
        browser.call("Page.navigate", json!({ "url": url }));
        browser.wait("document.readyState === 'complete' && location.protocol === 'file:'");
        browser
    }

    /// Calls a method and returns its result.
    pub(crate) fn call(&mut self, method: &str, params: Value) -> Value {
        self.calls += 1;
        let mut message = json!({ "id": self.calls, "method": method, "params": params });
        if let Some(session) = &self.session {
            message["sessionId"] = session.as_str().into();
        }
        self.to.write_all(format!("{message}\0").as_bytes()).expect("the browser listens");
        loop {
            let mut bytes = Vec::new();
            let count = self.from.read_until(0, &mut bytes).expect("the browser answers");
            assert!(count > 0, "the browser ended: does `{} --headless=new` run here?", program());
            let answer: Value = serde_json::from_slice(&bytes[..count - 1]).expect("JSON");
            if answer["id"] == self.calls {
                assert!(answer["error"].is_null(), "{method}: {}", answer["error"]);
                return answer["result"].clone();
            }
            self.events.push(answer);
        }
    }

    /// The value of an expression, awaited.
    pub(crate) fn eval(&mut self, expression: &str) -> Value {
        let params = json!({ "expression": expression, "awaitPromise": true, "returnByValue": true });
        let result = self.call("Runtime.evaluate", params);
        assert!(result["exceptionDetails"].is_null(), "{expression}: {}", result["exceptionDetails"]);
        result["result"]["value"].clone()
    }

    /// Waits until an expression is true.
    pub(crate) fn wait(&mut self, expression: &str) {
        let started = Instant::now();
        while self.eval(expression) != true {
            assert!(started.elapsed() < Duration::from_secs(30), "never true: {expression}");
            std::thread::sleep(Duration::from_millis(40));
        }
    }

    /// Waits until what was asked for has been drawn.
    pub(crate) fn settle(&mut self) {
        self.eval("new Promise(done => requestAnimationFrame(() => requestAnimationFrame(done)))");
    }

    /// A key as a person presses it.
    pub(crate) fn key(&mut self, key: &str) {
        self.key_down(key);
        self.key_up(key);
        self.settle();
    }

    /// A digit with shift, as a keyboard of the English layout sends it.
    pub(crate) fn shifted(&mut self, digit: u8, written: &str) {
        let key = json!({
            "type": "keyDown", "key": written, "text": written, "code": format!("Digit{digit}"), "modifiers": 8
        });
        self.call("Input.dispatchKeyEvent", key);
        self.key_up(written);
        self.settle();
    }

    /// Presses a key and holds it.
    pub(crate) fn key_down(&mut self, key: &str) {
        let text = if key.chars().count() == 1 { key } else { "" };
        let kind = if text.is_empty() { "rawKeyDown" } else { "keyDown" };
        self.call("Input.dispatchKeyEvent", json!({ "type": kind, "key": key, "text": text }));
        self.settle();
    }

    /// Lets a key go.
    pub(crate) fn key_up(&mut self, key: &str) {
        self.call("Input.dispatchKeyEvent", json!({ "type": "keyUp", "key": key }));
        self.settle();
    }

    /// Moves the mouse.
    pub(crate) fn point(&mut self, [x, y]: [f64; 2]) {
        self.call("Input.dispatchMouseEvent", json!({ "type": "mouseMoved", "x": x, "y": y }));
        self.settle();
    }

    /// What the page complained of: errors, warnings, exceptions.
    pub(crate) fn complaints(&self) -> Vec<String> {
        let bad = |e: &&Value| match e["method"].as_str().unwrap_or_default() {
            "Runtime.exceptionThrown" => true,
            "Runtime.consoleAPICalled" => e["params"]["type"] != "log",
            // Reading the canvas back is the test's own doing, and remarked on.
            "Log.entryAdded" if e["params"]["entry"]["source"] == "rendering" => false,
            "Log.entryAdded" => {
                e["params"]["entry"]["level"] != "info" && e["params"]["entry"]["level"] != "verbose"
            }
            _ => false,
        };
        self.events.iter().filter(bad).map(Value::to_string).collect()
    }

    /// What the page asked for, itself and what it carries in itself aside.
    pub(crate) fn requests(&self) -> Vec<String> {
        let sent = self.events.iter().filter(|e| e["method"] == "Network.requestWillBeSent");
        let urls = sent.filter_map(|e| e["params"]["request"]["url"].as_str().map(String::from));
        urls.filter(|url| !url.starts_with("data:")).collect()
    }
}

impl Drop for Browser {
    fn drop(&mut self) {
        let _ = self.child.kill();
        let _ = self.child.wait();
    }
}
