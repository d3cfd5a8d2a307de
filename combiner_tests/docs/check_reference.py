#!/usr/bin/env python3
"""Checks the pages that ./dev docs makes: check_reference.py FOLDER

Every link, picture and entry of the search leads to a file and an anchor that are there; every page can be reached from
the first; nothing is loaded from a network; no text shows raw markup or a path of the machine that built it; every class
stands in the group of a room.
"""
import html
import os
import pathlib
import re
import sys

ROOT = pathlib.Path(__file__).resolve().parent.parent.parent
TAG = re.compile(r'<[a-z][^>]*>', re.IGNORECASE)
ANCHOR = re.compile(r'\s(?:id|name)="([^"]*)"')
LINK = re.compile(r'\s(href|src)="([^"]*)"')
ENTRY = re.compile(r"'\.\./([^'#]+)#?([^']*)'")
# What the text of a page does not show: scripts, code, tooltips' contents of code.
HIDDEN = re.compile(r'<(script|style|pre|code|tt)\b.*?</\1>|<div class="(?:line|ttc)".*?</div>(?=\n)', re.DOTALL)
RAW = re.compile(r'[@\\](?:a|addtogroup|brief|c|code|copydoc|def|defgroup|endcode|f\$|file|include|ingroup|name|page|par|param|ref|return|'
                 r'section|see|snippet|subpage|verbatim)\b|\\f[$\[]|</?(?:a|b|br|code|dd|div|dl|dt|em|h\d|i|img|li|p|pre|span|table|td|tr|tt|ul)\b'
                 r'[^<>]*>|&(?:lt|gt|amp|quot|nbsp);|`|\]\([^)]|\*\*\w[^*]*\w\*\*|\|--|\{#\w|#include\b|'
                 r'(?<![\w*])\*[^\s*][^*]*[^\s*]\*(?![\w*])')


def read_pages(folder):
    """Each page with the targets of its links and its anchors."""
    pages = {}
    for path in sorted(folder.rglob('*.html')):
        if path.parent.name == 'playground':  # a program, which has tests of its own
            continue
        text = path.read_text(encoding='utf-8')
        tags = TAG.findall(text)
        pages[path] = (text, [link for tag in tags for link in LINK.findall(tag)],
                       {html.unescape(name) for tag in tags for name in ANCHOR.findall(tag)})
    return pages


def wrong_links(folder, pages):
    first = folder / 'index.html'
    leads_to = {}
    for path, (_, links, _) in pages.items():
        leads_to[path] = set()
        for kind, link in links:
            link = html.unescape(link)
            if re.match(r'(https?:|mailto:)', link):
                if kind == 'src':
                    yield f'{path.name}: loads {link}'
                continue
            if link.startswith('javascript:'):
                continue
            name, _, anchor = link.partition('#')
            name = name.partition('?')[0]
            target = pathlib.Path(os.path.normpath(path.parent / name)) if name else path
            if not target.is_relative_to(folder) or not target.exists():
                yield f'{path.name}: {link} leads nowhere'
            elif anchor and target in pages and anchor not in pages[target][2]:
                yield f'{path.name}: {link} has no such anchor'
            leads_to[path].add(target)
    for path in sorted((folder / 'search').glob('*_*.js')):
        for name, anchor in ENTRY.findall(path.read_text(encoding='utf-8')):
            target = folder / name
            if target not in pages or (anchor and anchor not in pages[target][2]):
                yield f'search/{path.name}: {name}#{anchor} leads nowhere'
    seen, ahead = {first}, [first]
    while ahead:
        for target in leads_to[ahead.pop()] - seen:
            seen.add(target)
            if target in pages:
                ahead.append(target)
    for path in pages:
        if path not in seen and path.parent.name != 'search' and not path.name.startswith('dir_'):
            yield f'{path.name}: no page leads here'


def wrong_texts(pages):
    for path, (text, _, _) in pages.items():
        for trace in (str(ROOT), 'file:/'):
            if trace in text:
                yield f'{path.name}: shows {trace}, a path of this machine'
        if path.parent.name == 'search' or path.name.endswith('_source.html'):
            continue
        shown = html.unescape(re.sub(r'<[^>]+>', '', HIDDEN.sub('', text)))
        for found in RAW.finditer(shown):
            yield f'{path.name}: shows markup: …{" ".join(shown[max(0, found.start() - 40):found.end() + 40].split())}…'


def wrong_groups(pages):
    for path, (text, _, _) in pages.items():
        parts = path.stem.split('_1_1')  # of a name with its scopes
        nested = f'{"_1_1".join(parts[:-1])}'
        inside = any(other.stem in (nested, nested.replace('struct', 'class', 1)) for other in pages if nested)
        if re.match(r'(class|struct)ninebit', path.stem) and not inside and 'class="ingroups"' not in text:
            yield f'{path.name}: is in no group; every class belongs to a room'


def main():
    folder = pathlib.Path(sys.argv[1]).resolve()
    pages = read_pages(folder)
    faults = [*wrong_links(folder, pages), *wrong_texts(pages), *wrong_groups(pages)]
    for sheet in folder.rglob('*.css'):
        if re.search(r'(url\(|@import)\s*["\']?(https?:)?//', sheet.read_text(encoding='utf-8')):
            faults.append(f'{sheet.name}: loads from a network')
    for fault in faults[:300]:
        print(fault)
    print(f'{len(pages)} pages, {sum(len(links) for _, links, _ in pages.values())} links, {len(faults)} faults')
    sys.exit(1 if faults or not pages else 0)


if __name__ == '__main__':
    main()
