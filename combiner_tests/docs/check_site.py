#!/usr/bin/env python3
"""Checks the site's live examples: check_site.py SITE

Each comment such as `<!-- playground: sepia -->` of a page is a frame with that effect of the gallery, and the file that
the frame names is there.
"""
import html
import pathlib
import re
import sys

root = pathlib.Path(__file__).resolve().parents[2]
site = pathlib.Path(sys.argv[1])
faults, frames = [], 0
for page in sorted((root / 'docs').rglob('*.md')):
    wanted = re.findall(r'^<!-- playground: (\w+) -->$', page.read_text(), re.MULTILINE)
    if not wanted:
        continue
    made = site / f'page_{page.stem.replace("-", "_")}.html'
    if not made.exists():
        faults.append(f'{made} is missing')
        continue
    found = [html.unescape(source) for source in re.findall(r'<iframe class="playground"[^>]* src="([^"]*)"', made.read_text())]
    frames += len(found)
    if [source.rpartition('effect=')[2] for source in found] != wanted:
        faults.append(f'{made} has live examples {found}; expected {wanted}')
    for source in found:
        if not (site / source.partition('?')[0]).is_file():
            faults.append(f'{made}: {source} names a file that is missing')
    faults += [f'{page}: the gallery has no effect {name}' for name in wanted
               if not (root / f'scenes/effects/{name}.json').exists()]
if not frames:
    faults.append(f'{site}: no page has a live example')
for fault in faults:
    print(fault, file=sys.stderr)
if not faults:
    print(f'{frames} live examples')
sys.exit(bool(faults))
