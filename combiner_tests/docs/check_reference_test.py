#!/usr/bin/env python3
"""Proves that check_reference.py finds each kind of fault: it runs on a small reference with one fault at a time."""
import pathlib
import subprocess
import sys
import tempfile

CHECK = pathlib.Path(__file__).with_name('check_reference.py')
PAGES = {
    'index.html': '<title>n</title><a href="room.html#top">Room</a> <a href="structninebit_1_1A.html">A</a> '
                  '<a href="https://example.org/">outside</a> <code>a[0](b) `c` **d**</code> char **text, char **error',
    'room.html': '<h1 id="top">Room</h1><img src="a.png"/><a href="search/all_0.html">S</a>',
    'structninebit_1_1A.html': '<div class="ingroups">Room</div>',
    'search/all_0.html': '<link href="search.css"/>',
    'search/all_0.js': "['a',['../room.html#top',1,'']]",
    'search/search.css': '@import "../style.css";',
    'style.css': 'a { background: url(a.png); }',
    'a.png': '',
}
# A page's change, and what the check says about it.
FAULTS = [
    ('index.html', 'room.html#top', 'rooms.html', 'rooms.html leads nowhere'),
    ('index.html', 'room.html#top', 'room.html#down', 'room.html#down has no such anchor'),
    ('index.html', '<a href="room.html#top">Room</a>', '', 'room.html: no page leads here'),
    ('room.html', 'a.png', 'b.png', 'b.png leads nowhere'),
    ('room.html', 'a.png', 'https://example.org/a.png', 'loads https://example.org/a.png'),
    ('room.html', 'a.png', '../a.png', '../a.png leads nowhere'),
    ('room.html', 'Room', 'See @ref state', 'shows markup'),
    ('room.html', 'Room', r'\f$ x \f$', 'shows markup'),
    ('room.html', 'Room', '&lt;a href=1&gt;', 'shows markup'),
    ('room.html', 'Room', '[Room](room.md)', 'shows markup'),
    ('room.html', 'Room', '`Room`', 'shows markup'),
    ('room.html', 'Room', '**Room**', 'shows markup'),
    ('room.html', 'Room', '*Room.* Hall', 'shows markup'),
    ('room.html', 'Room', 'x &amp;lt; y', 'shows markup'),
    ('room.html', 'Room', '#include &lt;a.h&gt;', 'shows markup'),
    ('room.html', 'Room', str(CHECK.parent.parent.parent) + '/a.h', 'a path of this machine'),
    ('structninebit_1_1A.html', 'ingroups', 'other', 'is in no group'),
    ('search/all_0.js', '#top', '#down', 'room.html#down leads nowhere'),
    ('style.css', 'a.png', 'https://example.org/a.png', 'loads from a network'),
]


def check(change=None):
    """The exit status of the check, and what it prints, on the pages with a change."""
    with tempfile.TemporaryDirectory() as folder:
        for name, text in PAGES.items():
            if change and name == change[0]:
                assert change[1] in text
                text = text.replace(change[1], change[2])
            path = pathlib.Path(folder, name)
            path.parent.mkdir(exist_ok=True)
            path.write_text(text, encoding='utf-8')
        done = subprocess.run([sys.executable, CHECK, folder], capture_output=True, text=True)
    return done.returncode, done.stdout + done.stderr


def main():
    failed = 0
    for change, expected, status in [(None, ' 0 faults', 0), *((fault[:3], fault[3], 1) for fault in FAULTS)]:
        got, printed = check(change)
        if got != status or expected not in printed:
            failed += 1
            print(f'{change}: expected {status} and "{expected}", got {got}:\n{printed}')
    print(f'{len(FAULTS) + 1} references, {failed} judged wrong')
    sys.exit(1 if failed else 0)


if __name__ == '__main__':
    main()
