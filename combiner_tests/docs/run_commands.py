#!/usr/bin/env python3
"""Runs the commands that pages of the documentation show, as a reader would who has just cloned the tree.

usage: run_commands.py [--here] PROGRAM PAGE ...

In fenced blocks without a language, a line that begins with `ninebit `, `python3 `, `cp `, `sed `, `cc ` or `./check `
is a command, `cat > FILE <<END` is one with all lines to END, and so is a line that begins with `$ ninebit ` or
`$ ./check `; the lines below the latter are what it prints, on both streams. Commands run from top to bottom, a page's in the same folder: a new one with
copies of docs/, scenes/, combiner_tests/hardware/ and src/combiner/c99/, or with --here the current one. Output is compared word by word, so
that a page may break lines; `…` stands for whatever a page leaves out. A command must exit with 0, or, where the page
shows its output, with 1 after a found fault or 3 after `ninebit: error:`.

HTML comments in front of a block, which readers do not see:
  <!-- not run: WHY -->      none of the block's commands is run
  <!-- run with: FLAGS -->   appended to those that lack the first of these flags, to make them quick: --size 160x120

HTML comments in prose:
  151<!-- value: EXPRESSION of ninebit ... -->   the figure before it, to the digits shown, is the value of a Python
      expression over the answer of the command with --json, such as errors.by_cause.joint, rows[0].cases or len(rows)
  <!-- picture: FILE -->   the picture behind it, or on the next line, looks like FILE, which a command above or below
      writes: the means of its blocks are the same within a few codes, as it may have been made smaller
  <!-- picture: FILE of ninebit ... -->   the same of a command that the page does not show
  <!-- picture: FILE at X,Y,WIDTHxHEIGHT of ninebit ... -->   the same of a part of the picture, with or without a command;
      several of these may stand before one picture. FILE from X,Y at ...: that part of FILE, not all of it
  <!-- not checked: WHY -->   the picture behind it, or on the next line, which is made by something else than the program;
      any other PNG file in a folder images/ must be checked

A word such as OPS_GLSL, which stands for a figure that is still to be put in, is a fault.

Exits with 1 if a command failed or printed something else, with 77 if every command was left out.
"""
import itertools
import json
import math
import os
import re
import shlex
import shutil
import struct
import subprocess
import sys
import tempfile
import time
import zlib

ROOT = os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
REMARK = re.compile(r'<!-- (not run|run with): (.*?) -->$')
COMMANDS = ('ninebit ', 'python3 ', 'cp ', 'sed ', 'cat > ', 'cc ', './check ')
SHOWN = ('$ ninebit ', '$ ./check ')
VALUE = re.compile(r'([-−]?\d[\d,.\u202f]*)(?: %)?<!-- value: (.*?) of (ninebit .*?) -->')
PICTURE = re.compile(r'<!-- picture: (\S+)(?:(?: from (\d+),(\d+))? at (\d+),(\d+),(\d+)x(\d+))?'
                     r'(?: of (ninebit .*?))? -->(?=(?:\n?<!-- picture: .*? -->)*\n?!\[.*?\]\((.*?)\))')
IMAGE = re.compile(r'(<!-- not checked: .+? -->\n?)?!\[.*?\]\((\S*images/\S+\.png)\)')
MISSING = re.compile(r'\b(?:STEPS|OPS)_[A-Z]+\b')  # stands for a figure that nobody has put in
LIMIT_S = 300
LIKE = 9  # codes by which the means of blocks of two pictures may differ


class Command:
    def __init__(self, line_number, text, output):
        self.line_number, self.text, self.output = line_number, text, output
        self.flags, self.reason = '', None


def read_block(lines, begin):
    """The commands of the block whose fence stands at lines[begin], and the number of the line behind it."""
    commands, at = [], begin + 1
    while at < len(lines) and lines[at] != '```':
        text, number = lines[at], at + 1
        shown = text.startswith(SHOWN)
        if shown or text.startswith(COMMANDS):
            while text.endswith('\\') or (text.startswith('cat > ') and not text.endswith('\nEND')):
                at += 1
                text += '\n' + lines[at]
            commands.append(Command(number, text.removeprefix('$ '), [] if shown else None))
        elif commands and commands[-1].output is not None:
            commands[-1].output.append(text)
        at += 1
    return commands, at + 1


def commands_of(page):
    with open(page, encoding='utf-8') as file:
        lines = file.read().split('\n')
    found, at, flags, reason = [], 0, '', None
    while at < len(lines):
        remark = REMARK.match(lines[at])
        if remark:
            reason, flags = (remark[2], flags) if remark[1] == 'not run' else (reason, remark[2])
            at += 1
        elif lines[at].startswith('```'):
            plain = lines[at] == '```'
            commands, at = read_block(lines, at)
            for command in commands if plain else []:
                command.flags = '' if flags and flags.split()[0] in command.text else flags
                command.reason = reason
                found.append(command)
            flags, reason = '', None
        else:
            if lines[at].strip() and (flags or reason):
                raise SystemExit(f'{page}:{at + 1}: the comment above stands before no block')
            at += 1
    return found


def agree(shown, printed):
    words = [re.escape(word) for word in ' '.join(shown).split()]
    pattern = r'\s+'.join(words).replace(r'\s+…\s+', r'\s(.*\s)?').replace('…', '.*')
    return re.fullmatch(pattern, printed.strip(), re.DOTALL) is not None


def run(command, folder, program):
    """What is wrong with a command, or None."""
    environment = dict(os.environ, NO_COLOR='1')
    function = f'ninebit() {{ {shlex.quote(program)} "$@" {command.flags}; }}\n'
    result = subprocess.run(['bash', '-o', 'pipefail', '-c', function + command.text], cwd=folder, env=environment,
                            stdin=subprocess.DEVNULL, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True,
                            timeout=LIMIT_S, check=False)
    expected = (0,)
    if command.output is not None:
        expected = (3,) if 'ninebit: error:' in ' '.join(command.output) else (0, 1)
    if result.returncode not in expected:
        return f'it exits with {result.returncode} and prints\n{result.stdout}'
    if command.output is not None and not agree(command.output, result.stdout):
        return f'it prints\n{result.stdout}\n  where the page shows\n' + '\n'.join(command.output)
    return None


class Keys(dict):
    """A JSON object whose keys are attributes, for expressions."""
    __getattr__ = dict.__getitem__


def run_hidden(command, folder, program, answers):
    """Runs a command of a comment once; what is wrong with it, or None."""
    if command in answers:
        return None
    function = f'ninebit() {{ {shlex.quote(program)} "$@"; }}\n'
    result = subprocess.run(['bash', '-c', f'{function}{command} --json --quiet'], cwd=folder, stdin=subprocess.DEVNULL,
                            stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True, timeout=LIMIT_S, check=False)
    if result.returncode not in (0, 1):
        return f'it exits with {result.returncode} and prints\n{result.stderr}'
    answers[command] = json.loads(result.stdout, object_hook=Keys)
    return None


def wrong_value(shown, expression, command, folder, program, answers):
    """What is wrong with a figure in prose, or None."""
    if fault := run_hidden(command, folder, program, answers):
        return fault
    value = eval(expression, {'__builtins__': {}, 'len': len, 'sum': sum, 'max': max, 'min': min}, answers[command])
    plain = shown.rstrip(',.').replace(',', '').replace('\u202f', '').replace('−', '-')
    decimals = len(plain.partition('.')[2])
    if abs(value - float(plain)) <= 0.5 * 10 ** -decimals * (1 + 1e-9):
        return None
    return f'it is {value}; the page shows {shown}'


def pixels_of(file):
    """The width, the height and the red, green and blue rows of a PNG file of eight bits, not interlaced."""
    with open(file, 'rb') as opened:
        data = opened.read()
    width, height, depth, kind = struct.unpack('>IIBB', data[16:26])
    channels = {0: 1, 2: 3, 6: 4}[kind]
    assert depth == 8, file
    packed, at = b'', 8
    while at < len(data):
        size, name = struct.unpack('>I4s', data[at:at + 8])
        packed += data[at + 8:at + 8 + size] if name == b'IDAT' else b''
        at += size + 12
    raw, rows, above = zlib.decompress(packed), [], [bytes(width)] * channels
    for start in range(0, height * (1 + width * channels), 1 + width * channels):
        line = raw[start + 1:start + 1 + width * channels]
        above = [unfiltered(raw[start], line[c::channels], above[c]) for c in range(channels)]
        rows.append(above * 3 if channels == 1 else above[:3])
    return width, height, rows


def unfiltered(kind, line, above):
    """A row of one channel of a PNG file, below the row `above`."""
    if kind == 0:
        return line
    if kind == 1:
        return bytes(code & 255 for code in itertools.accumulate(line))
    if kind == 2:
        return bytes((code + up) & 255 for code, up in zip(line, above))
    out, left, corner = bytearray(), 0, 0
    for code, up in zip(line, above):
        if kind == 3:
            near = (left + up) // 2
        else:
            a, b, c = abs(up - corner), abs(left - corner), abs(left + up - 2 * corner)
            near = left if a <= b and a <= c else up if b <= c else corner
        left, corner = (code + near) & 255, up
        out.append(left)
    return out


def means_of(picture, across, down):
    """The means of a picture's blocks, for red, green and blue."""
    width, height, rows = picture
    w, h = width // across, height // down
    return [sum(sum(rows[y][c][x * w:x * w + w]) for y in range(j * h, j * h + h)) / (w * h)
            for c in range(3) for j in range(down) for x in range(across)]


def part_of(picture, left, top, width, height):
    return width, height, [[channel[left:left + width] for channel in row] for row in picture[2][top:top + height]]


def wrong_picture(shown, made, start, part):
    """What is wrong with a picture of a page, or None. `part`: left, top, width and height in it, if it is not all of it;
    `start`: left and top of that part in the file, if it has more."""
    if not os.path.exists(made):
        return f'no command writes {os.path.basename(made)}'
    pictures = [pixels_of(shown), pixels_of(made)]
    for number, place in enumerate((part, start and start + part[2:])):
        if place:
            width, height = pictures[number][:2]
            if place[0] + place[2] > width or place[1] + place[3] > height:
                return f'a part of {place[2]} x {place[3]} pixels at {place[0]},{place[1]} reaches beyond {width} x {height}'
            pictures[number] = part_of(pictures[number], *place)
    across, down = (math.gcd(a, b) // 4 for a, b in zip(pictures[0][:2], pictures[1]))
    if min(across, down) < 6:
        return f'sides of {pictures[0][:2]} and {pictures[1][:2]} pixels have no blocks in common'
    worst = max(abs(a - b) for a, b in zip(*(means_of(picture, across, down) for picture in pictures)))
    return None if worst <= LIKE else f'the means of blocks differ by up to {worst:.1f} codes'


def check_prose(program, page, folder):
    """How many figures and pictures of a page were checked, and how many of them are wrong."""
    with open(page, encoding='utf-8') as file:
        text = file.read()
    answers = {}
    checks = [(found, lambda m: wrong_value(m[1], m[2], m[3], folder, program, answers)) for found in VALUE.finditer(text)]
    checks += [(found, lambda m: (m[8] and run_hidden(m[8], folder, program, answers)) or
                wrong_picture(os.path.join(os.path.dirname(page), m[9]), os.path.join(folder, m[1]),
                              [int(n) for n in m.groups()[1:3] if n], [int(n) for n in m.groups()[3:7] if n]))
               for found in PICTURE.finditer(text)]
    checked = failed = text.count('<!-- value:') + text.count('<!-- picture:') - len(checks)
    if failed:
        print(f'FAILED {os.path.relpath(page, ROOT)}: a comment is not "<!-- value: EXPRESSION of ninebit ... -->" behind a '
              'figure or "<!-- picture: FILE -->" before a picture')
    checks += [(found, lambda m: 'a figure is missing') for found in MISSING.finditer(text)]
    seen = {found[9] for found in PICTURE.finditer(text)}
    checks += [(found, lambda m: 'the picture is not checked') for found in IMAGE.finditer(text)
               if not found[1] and found[2] not in seen]
    for found, check in checks:
        fault = check(found)
        checked += 1
        failed += fault is not None
        where = f'{os.path.relpath(page, ROOT)}:{text.count(chr(10), 0, found.start()) + 1}: {found[0]!r:.100}'
        print(f'{"FAILED" if fault else "passed"}  {where}{f": {fault}" if fault else ""}', flush=True)
    return checked, failed


def run_page(program, page, folder):
    """How many of a page's commands ran, how many of its figures were checked, and how many of both are wrong."""
    ran = failed = 0
    for command in commands_of(page):
        where = f'{os.path.relpath(page, ROOT)}:{command.line_number}: ' + ' '.join(command.text.split())
        if command.reason is not None:
            print(f'not run  {where} ({command.reason})')
            continue
        begin = time.monotonic()
        fault = run(command, folder, program)
        ran += 1
        failed += fault is not None
        print(f'{"FAILED" if fault else "passed"} {time.monotonic() - begin:5.1f} s  {where}', flush=True)
        if fault:
            print(f'  {fault}')
    checked, wrong = check_prose(program, page, folder)
    return ran, checked, failed + wrong


def run_in_copies(program, page):
    with tempfile.TemporaryDirectory() as folder:
        for name in ('docs', 'scenes', 'combiner_tests/hardware', 'src/combiner/c99'):
            shutil.copytree(os.path.join(ROOT, name), os.path.join(folder, name))
        return run_page(program, page, folder)


def main():
    words = sys.argv[1:]
    here = words[:1] == ['--here']
    program, *pages = words[here:] or ['']
    if not pages:
        raise SystemExit(__doc__)
    program = os.path.abspath(program)
    counts = [run_page(program, page, '.') if here else run_in_copies(program, page) for page in pages]
    ran, checked, failed = (sum(column) for column in zip(*counts))
    print(f'{ran} commands, ' + (f'{checked} figures, ' if checked else '') + f'{failed} failed')
    sys.exit(1 if failed else 0 if ran + checked else 77)


if __name__ == '__main__':
    main()
