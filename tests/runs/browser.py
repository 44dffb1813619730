"""Looks at HTML pages in headless Chromium."""

import html
import json
import pathlib
import re
import shutil
import subprocess

from crevasse_run import check

WIDTHS = (400, 1400)
HOST = """<!DOCTYPE html><pre id="found">nothing</pre>
<script>
const found = [], charts = "canvas:not(#field-canvas)";
function look(frame) {
  const page = frame.contentWindow, body = page.document.documentElement;
  const blank = [...page.document.querySelectorAll(charts)].filter((canvas) =>
    canvas.offsetParent && !canvas.getContext("2d").getImageData(
      0, 0, canvas.width, canvas.height).data.some((value) => value > 0));
  found.push({page: frame.name, width: frame.width,
              overflow: body.scrollWidth - body.clientWidth,
              canvases: page.document.querySelectorAll(charts).length,
              charts: page.eval("typeof charts === 'undefined' ? 0 : charts.length"),
              pictures: [...page.document.images].filter((image) =>
                image.naturalWidth > 100).length,
              blank: blank.length, ...use(page)});
}

// Hovers over the second point of the first chart and asks for the last period.
function use(page) {
  const button = page.document.querySelector("button[data-view=last]");
  if (page.eval("typeof charts === 'undefined'")) return {};
  const chart = page.eval("charts[0]");
  chart.tooltip.setActiveElements([{ datasetIndex: 0, index: 1 }], { x: 1, y: 1 });
  chart.update();
  const words = [...chart.tooltip.title,
                 ...chart.tooltip.body.flatMap((part) => part.lines)];
  if (button) button.click();
  return {words, begin: button ? chart.scales.x.min : null};
}
addEventListener("load", () => {
  for (const frame of document.querySelectorAll("iframe")) look(frame);
  document.getElementById("found").textContent = JSON.stringify(found);
});
</script>
"""
BROKEN = """<!DOCTYPE html><div style="width: 3000px">wide</div>
<canvas></canvas><script>doesNotExist();</script>"""


def in_browser(pages):
    """Each page in a frame of each width, all in one start of the browser. A page
    that is broken on purpose shows that faults are seen."""
    pathlib.Path("broken.html").write_text(BROKEN)
    pages = {"broken": pathlib.Path("broken.html"), **pages}
    frames = [f'<iframe name="{name}" width="{width}" height="900" '
              f'src="{path.resolve().as_uri()}"></iframe>'
              for name, path in pages.items() for width in WIDTHS]
    return open_host(HOST + "\n".join(frames))


def open_host(text, *options):
    """What the page wrote into the element "found", and what the browser said."""
    browser = shutil.which("chromium")
    check(browser, "Chromium, in which reports are looked at, is not installed: "
                   "apt-get install -y --no-install-recommends chromium")
    host = pathlib.Path("host.html")
    host.write_text(text)
    process = subprocess.run(
        [browser, "--headless", "--no-sandbox", "--use-angle=swiftshader",
         "--enable-unsafe-swiftshader", "--allow-file-access-from-files",
         "--enable-logging=stderr",
         f"--user-data-dir={pathlib.Path('browser').resolve()}",
         "--window-size=1500,1000", "--virtual-time-budget=60000", *options,
         "--dump-dom", host.resolve().as_uri()],
        text=True, capture_output=True, timeout=600)
    shutil.rmtree("browser", ignore_errors=True)
    found = re.search(r'<pre id="found">(.*?)</pre>', process.stdout, re.S)
    check(found and found[1] != "nothing",
          f"Chromium showed nothing:\n{process.stderr[-2000:]}")
    console = [line for line in process.stderr.splitlines() if "CONSOLE" in line]
    return json.loads(html.unescape(found[1])), console
