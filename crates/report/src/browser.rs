//! Every kind of page in a real browser: Chromium without a window, where there is one.

use std::path::{Path, PathBuf};
use std::process::Command;
use std::{env, fs};

use serde::Deserialize;

use crate::sample;

/// Widths of a phone and of a desk (px), and what is allowed beyond: nothing.
const WIDTHS: [u32; 2] = [380, 1400];

/// Least contrast of letters in drawings (WCAG 2.1, criterion 1.4.3, large text).
const LEAST_CONTRAST: f64 = 3.0;

/// Least height of letters of plots (px).
const LEAST_LETTERS: f64 = 10.0;

/// What the browser saw of one page at one width.
#[derive(Debug, Deserialize)]
#[allow(dead_code, reason = "told where an assertion fails")]
struct Seen {
    page: String,
    width: f64,
    scrolls_to: f64,
    scripted: bool,
    resources: usize,
    least_contrast: f64,
    least_letters: f64,
    is_dark: bool,
    plots: usize,
    beyond: String,
    told: String,
    zooms: bool,
    sorts: bool,
    copies: usize,
}

/// Loads every page in frames, looks at it and tells what it saw.
const LOOK: &str = r#"
const seen = [];
const rgb = (text) => (text.match(/[\d.]+/g) || [0, 0, 0]).slice(0, 3).map(Number);
const light = (c) => c.map((v) => v / 255).map((v) => v <= 0.04045 ? v / 12.92 : ((v + 0.055) / 1.055) ** 2.4)
  .reduce((sum, v, i) => sum + v * [0.2126, 0.7152, 0.0722][i], 0.05);
const contrast = (a, b) => Math.max(light(a), light(b)) / Math.min(light(a), light(b));
const look = (frame) => {
  const view = frame.contentWindow, page = frame.contentDocument, root = page.documentElement;
  page.querySelectorAll("details").forEach((details) => { details.open = true; });
  const ground = rgb(view.getComputedStyle(page.body).backgroundColor);
  const plot = page.querySelector("svg.plot");
  let told = "", zooms = !plot;
  if (plot) {
    const area = plot.getBoundingClientRect();
    plot.dispatchEvent(new view.PointerEvent("pointermove", { clientX: area.left + area.width / 2, clientY: area.top + 5 }));
    told = page.querySelector(".values").hidden ? "" : page.querySelector(".values").textContent;
    const inner = plot.querySelector("svg"), before = inner.getAttribute("viewBox");
    plot.dispatchEvent(new view.KeyboardEvent("keydown", { key: "+" }));
    zooms = inner.getAttribute("viewBox") !== before;
    plot.dispatchEvent(new view.KeyboardEvent("keydown", { key: "0" }));
    zooms = zooms && inner.getAttribute("viewBox") === before;
  }
  const head = page.querySelector("th.sorts"), body = head?.closest("table").tBodies[0];
  const first = () => [...body.rows].map((row) => row.cells[0].textContent).join();
  let sorts = !head;
  if (head) {
    const before = first();
    head.click();
    const up = first();
    head.click();
    const down = first();
    head.click();
    sorts = up !== down && first() === before;
  }
  const texts = [...page.querySelectorAll("svg text")];
  const letters = [...page.querySelectorAll("svg.plot text, svg.dots text")];
  const beyond = [...page.querySelectorAll("body *")].filter((e) => e.getBoundingClientRect().right > view.innerWidth && !e.closest(".scroll, .drawing, svg"));
  seen.push({
    page: frame.src.split("/").pop(),
    width: view.innerWidth,
    scrolls_to: root.scrollWidth,
    scripted: root.classList.contains("scripted"),
    resources: view.performance.getEntriesByType("resource").length,
    least_contrast: Math.min(21, ...texts.map((text) => contrast(rgb(view.getComputedStyle(text).fill), ground))),
    least_letters: Math.min(99, ...letters.map((text) => text.getBoundingClientRect().height)),
    is_dark: light(ground) < 0.2,
    plots: page.querySelectorAll("svg.plot").length,
    beyond: beyond.slice(-3).map((e) => e.outerHTML.slice(0, 120)).join(),
    told, zooms, sorts,
    copies: page.querySelectorAll("pre").length - [...page.querySelectorAll("button")].filter((b) => b.textContent === "Copy").length,
  });
};
addEventListener("load", () => {
  document.querySelectorAll("iframe").forEach(look);
  document.getElementById("seen").textContent = encodeURIComponent(JSON.stringify(seen));
});
"#;

/// The browser, by the names that it has.
fn chromium() -> Option<PathBuf> {
    let folders: Vec<PathBuf> = env::split_paths(&env::var_os("PATH")?).collect();
    let names = ["chromium", "chromium-browser", "google-chrome"];
    let all = names.iter().flat_map(|name| folders.iter().map(move |folder| folder.join(name)));
    all.into_iter().find(|path| path.is_file())
}

/// Every kind of page.
fn pages() -> Vec<(&'static str, String)> {
    let arm = sample::arm();
    let text = "<robot name=\"arm\"/>".repeat(30);
    let export = exchange::Export { text, fates: Vec::new(), robot: arm.robot.clone() };
    let descriptions = [(exchange::Format::Urdf, export)];
    let report = crate::diagnosis::report::Report { descriptions: &descriptions, ..arm.report() };
    vec![
        ("diagnosis.html", crate::diagnosis::page::html(&report).unwrap()),
        ("run.html", crate::run::sample::run().report().page().unwrap()),
        ("tracking.html", crate::tracking::sample::comparison().page().unwrap()),
        ("learning.html", crate::learning::sample::comparison().page().unwrap()),
        ("replay.html", crate::replay::sample::sample().page().unwrap()),
    ]
}

/// What the browser saw, and what it wrote of errors.
fn look(browser: &Path, folder: &Path, scheme: &str) -> (Vec<Seen>, Vec<String>) {
    let output = Command::new(browser)
        .args(["--headless", "--no-sandbox", "--disable-gpu", "--no-first-run"])
        .args(["--disable-background-networking", "--disable-component-update"])
        .args(["--host-resolver-rules=MAP * ~NOTFOUND", "--allow-file-access-from-files"])
        .args(["--enable-logging=stderr", "--window-size=1600,1200", "--dump-dom"])
        .arg(format!("--user-data-dir={}", folder.join("profile").display()))
        .arg(format!("--blink-settings=preferredColorScheme={scheme}"))
        .arg(folder.join("frames.html"))
        .output()
        .unwrap();
    let dom = String::from_utf8_lossy(&output.stdout).into_owned();
    let log = String::from_utf8_lossy(&output.stderr).into_owned();
    let told = dom.split("id=\"seen\">").nth(1).and_then(|rest| rest.split('<').next());
    let told = told.filter(|told| !told.is_empty()).unwrap_or_else(|| panic!("{dom}{log}"));
    let console = log.lines().filter(|line| line.contains("CONSOLE")).map(str::to_owned);
    (serde_json::from_str(&decode(told)).unwrap(), console.collect())
}

/// Text from its percent-encoding.
fn decode(text: &str) -> String {
    let mut pieces = text.split('%');
    let mut bytes = pieces.next().unwrap_or_default().as_bytes().to_vec();
    for piece in pieces {
        let (code, rest) = piece.split_at(2);
        bytes.push(u8::from_str_radix(code, 16).unwrap());
        bytes.extend(rest.as_bytes());
    }
    String::from_utf8(bytes).unwrap()
}

#[test]
fn every_page_fits_phone_and_desk_by_day_and_night_without_errors_or_requests() {
    let Some(browser) = chromium() else {
        eprintln!("skipped: no Chromium in PATH, pages are not opened in a browser");
        return;
    };
    let folder = tempfile::tempdir().unwrap();
    let mut frames = String::new();
    for (name, page) in pages() {
        fs::write(folder.path().join(name), page).unwrap();
        for width in WIDTHS {
            frames.push_str(&format!(
                "<iframe src=\"{name}\" width=\"{width}\" height=\"900\" style=\"border:0\"></iframe>\n"
            ));
        }
    }
    let frames = format!(
        "<!DOCTYPE html><meta charset=\"utf-8\"><body>{frames}<pre id=\"seen\"></pre>\
         <script>{LOOK}</script></body>"
    );
    fs::write(folder.path().join("frames.html"), frames).unwrap();
    for (scheme, is_dark) in [("0", true), ("1", false)] {
        let (all, console) = look(&browser, folder.path(), scheme);
        assert!(console.is_empty(), "{console:#?}");
        assert_eq!(all.len(), WIDTHS.len() * pages().len());
        for seen in all {
            assert!(seen.scripted && seen.resources == 0, "{seen:?}");
            assert!(seen.scrolls_to <= seen.width, "{seen:?}");
            assert!(seen.is_dark == is_dark && seen.least_contrast >= LEAST_CONTRAST, "{seen:?}");
            assert!(seen.least_letters >= LEAST_LETTERS, "{seen:?}");
            assert!(seen.zooms && seen.sorts && seen.copies == 0, "{seen:?}");
            if seen.plots > 0 {
                assert!(seen.told.contains("model") || seen.told.contains("rad"), "{seen:?}");
            }
        }
    }
}
