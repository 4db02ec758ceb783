//! The page of a report in a browser without a window: what it lays out on a phone, what it loads, what it prints.
//!
//! Without Chromium in the path the test is left out and says so; with `PERCOAT_REQUIRE_CHROMIUM=1` it is demanded.

use crate::program::{Desk, Folder};
use std::env;
use std::path::PathBuf;
use std::process::Command;

fn chromium() -> Option<PathBuf> {
    let names = ["chromium", "chromium-browser", "google-chrome"];
    let path = env::var_os("PATH").unwrap_or_default();
    let found =
        env::split_paths(&path).flat_map(|folder| names.map(|name| folder.join(name))).find(|file| file.is_file());
    let demanded = env::var_os("PERCOAT_REQUIRE_CHROMIUM").is_some_and(|value| value == "1");
    assert!(found.is_some() || !demanded, "PERCOAT_REQUIRE_CHROMIUM=1, and no {} in the path", names.join(", "));
    found
}

/// Shows the page in a frame as wide as a phone, and measures there.
const PHONE: &str = r#"<!DOCTYPE html><meta charset="utf-8"><p id="found"></p>
<iframe id="phone" style="width:390px;height:800px;border:0" srcdoc="PAGE"></iframe>
<script>
document.getElementById("phone").onload = (event) => {
  const page = event.target.contentDocument, root = page.documentElement, images = [...page.images];
  const loaded = event.target.contentWindow.performance.getEntriesByType("resource").filter((resource) => !resource.name.startsWith("data:"));
  const small = [...page.querySelectorAll("p, td, th, li, dd")].filter((element) => parseFloat(event.target.contentWindow.getComputedStyle(element).fontSize) < 12);
  document.getElementById("found").textContent = [
    `width ${event.target.contentWindow.innerWidth}`, `too wide ${root.scrollWidth - root.clientWidth}`, `images ${images.length}`,
    `drawn ${images.filter((image) => image.complete && image.naturalWidth > 100).length}`, `loaded ${loaded.length}`,
    `small ${small.length}`, `styled ${page.styleSheets.length}`, `end`].join("; ");
};
</script>"#;

#[test]
fn the_page_fits_a_phone_loads_nothing_and_prints() {
    let Some(chromium) = chromium() else {
        eprintln!("left out: no Chromium in the path");
        return;
    };
    let desk = Desk::new();
    let arguments =
        ["dlc-on-steel", "--pictures", "svg", "--set", "grid.points=48", "--set", "load.mean_pressure=[0.05, 0.2]"];
    desk.solve("run", &arguments);
    desk.succeeds(&["report", "run"]);
    let page = Folder(desk.path("run")).text("report.html");
    desk.write("phone.html", PHONE.replace("PAGE", &page.replace('&', "&amp;").replace('"', "&quot;")));
    let browse = |arguments: &[String], file: &str| {
        let common = [
            "--headless",
            "--no-sandbox",
            "--disable-gpu",
            "--hide-scrollbars",
            "--host-resolver-rules=MAP * ~NOTFOUND",
        ];
        let profile = format!("--user-data-dir={}", desk.path("profile").display());
        let page = format!("file://{}", desk.path(file).display());
        let output = Command::new(&chromium).args(common).arg(profile).args(arguments).arg(page).output().unwrap();
        assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
        String::from_utf8_lossy(&output.stdout).into_owned()
    };
    let shown = browse(&["--dump-dom".to_owned()], "phone.html");
    let found = shown.split_once("id=\"found\">").and_then(|(_, rest)| rest.split("</p>").next()).unwrap_or_default();
    assert_eq!(found, "width 390; too wide 0; images 6; drawn 6; loaded 0; small 0; styled 1; end");
    let print = desk.path("report.pdf");
    browse(&["--no-pdf-header-footer".to_owned(), format!("--print-to-pdf={}", print.display())], "run/report.html");
    let printed = std::fs::read(print).unwrap();
    let pages = printed.windows(12).filter(|part| part.starts_with(b"/Type /Page\n")).count();
    assert!(printed.starts_with(b"%PDF") && (4..=12).contains(&pages), "{pages} pages");
}
