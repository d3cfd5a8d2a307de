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

Exits with 1 if a command failed or printed something else, with 77 if every command was left out.
"""
import os
import re
import shlex
import shutil
import subprocess
import sys
import tempfile
import time

ROOT = os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
REMARK = re.compile(r'<!-- (not run|run with): (.*?) -->$')
COMMANDS = ('ninebit ', 'python3 ', 'cp ', 'sed ', 'cat > ', 'cc ', './check ')
SHOWN = ('$ ninebit ', '$ ./check ')
LIMIT_S = 300


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


def run_page(program, page, folder):
    """How many of a page's commands ran, and how many of them failed."""
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
    return ran, failed


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
    ran, failed = (sum(column) for column in zip(*counts))
    print(f'{ran} commands, {failed} failed')
    sys.exit(1 if failed else 0 if ran else 77)


if __name__ == '__main__':
    main()
