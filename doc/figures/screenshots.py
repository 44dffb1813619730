#!/usr/bin/python3
# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 by the Crevasse authors

"""The screenshots of doc/report.md: the report of the paper's example and the field
view of two cracks, as Chromium shows them. A run that is done is not done again."""

import pathlib
import shutil
import subprocess
import sys
import tempfile

from PIL import Image

from study import run_once, study_options  # first: finds the package

# Scene, settings, and parts of its report below one another: anchor and height.
PICTURES = {
    "report": ("raous1980", (), (("", 520), ("#histories", 490))),
    "field_view": ("two_cracks", ("Output/Field times=12 instants",),
                   (("#fields", 690),))}
WIDTH = 960
HOST = "<!DOCTYPE html><style>body { margin: 0 } iframe { display: block; border: 0; }\n" \
       "iframe + iframe { border-top: 6px solid #d8d8d8; }</style>\n"


def write_host(options, scene, settings, parts, directory):
    """A page with the parts of the report in frames, and its height."""
    results = run_once(options, scene, settings=settings)
    report = directory / "report.html"
    subprocess.run([options.program, "report", results, "--output", report], check=True)
    # The folder as a reader of the page has it.
    report.write_text(report.read_text().replace(str(results.resolve()),
                                                 f"results/{scene}"))
    host = directory / "host.html"
    host.write_text(HOST + "\n".join(
        f'<iframe src="report.html{anchor}" width="{WIDTH}" height="{height}"></iframe>'
        for anchor, height in parts))
    return host, sum(height for _, height in parts) + 6 * (len(parts) - 1)


def photograph(browser, page, height, target):
    shot = page.with_name("shot.png")
    result = subprocess.run(
        [browser, "--headless", "--no-sandbox", "--use-gl=angle",
         "--use-angle=swiftshader", "--enable-unsafe-swiftshader", "--hide-scrollbars",
         f"--user-data-dir={page.with_name('profile')}",
         f"--window-size={WIDTH},{height}", "--virtual-time-budget=60000",
         f"--screenshot={shot}", page.as_uri()], stderr=subprocess.PIPE, text=True)
    if not shot.exists():
        sys.exit(f"Chromium made no screenshot:\n{result.stderr}")
    image = Image.open(shot).convert("RGB")
    image.quantize(128, dither=Image.Dither.NONE).save(target, optimize=True)
    print(target)


def main():
    options = study_options(__doc__, "screenshots")
    browser = shutil.which("chromium")
    if browser is None:
        print("Chromium is not installed: report.png and field_view.png stay as they "
              "are.", file=sys.stderr)
        return
    for name, picture in PICTURES.items():
        with tempfile.TemporaryDirectory() as directory:
            host, height = write_host(options, *picture, pathlib.Path(directory))
            photograph(browser, host, height, options.figures / f"{name}.png")


main()
