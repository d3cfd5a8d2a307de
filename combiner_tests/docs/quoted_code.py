#!/usr/bin/env python3
"""Checks that code which a page quotes stands in the sources.

usage: quoted_code.py PAGE ...

A fenced block below `<!-- from FILE -->`, FILE being a path from the root, must stand in that file as it is, indentation
and line breaks apart. Exits with 1 if one does not, or if there is none at all.
"""
import os
import re
import sys

ROOT = os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
QUOTE = re.compile(r'^<!-- from (\S+) -->\n```\w*\n(.*?)^```$', re.DOTALL | re.MULTILINE)


def words(text):
    return ' '.join(text.split())


def read(path):
    with open(path, encoding='utf-8') as file:
        return file.read()


def main():
    quotes = failed = 0
    for page in sys.argv[1:]:
        for source, code in QUOTE.findall(read(page)):
            quotes += 1
            if words(code) not in words(read(os.path.join(ROOT, source))):
                failed += 1
                print(f'{os.path.relpath(page, ROOT)}: this does not stand in {source}:\n{code}')
    print(f'{quotes} quotes, {failed} of them wrong')
    sys.exit(1 if failed or not quotes else 0)


if __name__ == '__main__':
    main()
