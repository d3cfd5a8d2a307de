#!/usr/bin/env python3
"""Runs the tests of a build as ctest does, but many cases of a GoogleTest program in one process, because starting the
programs takes longer than most cases: combiner_tests/run_tests.py PRESET JOBS [what ctest takes to choose tests ...]

What fails in company is run again alone, and only that decides; the same holds for cases that a batch did not reach. So a
failure is one of ctest's, and `ctest --preset PRESET -R NAME` repeats it.
"""
import collections
import concurrent.futures
import json
import os
import pathlib
import re
import resource
import subprocess
import sys
import time

# Cases that change their process for good, or that fork: each has its own.
ALONE = re.compile(r'Memory|Limits|Isolated|Interrupt|Folder|Hostile|Killed|FullDisk|WriteError|Corpus|Environment|AnyThreads')
# Cases that wait for something to exceed its time: they need no core, so they run beside all others, one at a time.
WAITING = re.compile(r'IsolatedReader[.]Hangs|SurvivesWhatItCalls|EndsWhatDoesNotEnd')
CASES_A_BATCH = 24
BATCH_SECONDS = 600
# What takes long begins first, so that no core waits for it at the end: as the last run of the build folder measured it,
# and where there was none, these.
LONG = re.compile(r'docs[.](README|study/datapath|tutorials|performance)|Flags|HostileJudge|Kit|Memory|page[.]|'
                  r'python[.](package|verbs|long_calls)|Interrupt|Differential|IndexSteps|EmitC|RealNumbers')


def chosen_tests(preset, arguments):
    """What ctest would run, with the commands."""
    listed = subprocess.run(['ctest', '--preset', preset, '--show-only=json-v1', *arguments], check=True, text=True,
                            capture_output=True).stdout
    tests = []
    for test in json.loads(listed)['tests']:
        if 'command' not in test:
            sys.exit(f"{test['name']} is not built")
        properties = {p['name']: p['value'] for p in test.get('properties', [])}
        tests.append({'name': test['name'], 'command': test['command'], 'properties': properties})
    return tests


def preset_environment(preset):
    """The variables that CMakePresets.json sets for the tests of a preset; ctest lists them nowhere."""
    root = pathlib.Path(__file__).resolve().parent.parent
    for one in json.loads((root / 'CMakePresets.json').read_text())['testPresets']:
        if one['name'] == preset:
            return {name: value.replace('${sourceDir}', str(root)) for name, value in one.get('environment', {}).items()}
    return {}


def case_of(test):
    """The case's name in its GoogleTest program; None for other tests."""
    for word in test['command'][1:]:
        if word.startswith('--gtest_filter='):
            return word.removeprefix('--gtest_filter=')
    return None


def run(command, properties, seconds):
    """The exit status (None: too long), what was printed, and the time."""
    begin = time.monotonic()
    environment = dict(os.environ)
    for setting in properties.get('ENVIRONMENT', []):
        name, _, value = setting.partition('=')
        environment[name] = value
    with subprocess.Popen(command, stdin=subprocess.DEVNULL, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True,
                          errors='replace', env=environment, cwd=properties.get('WORKING_DIRECTORY'),
                          start_new_session=True) as process:
        try:
            output, status = process.communicate(timeout=seconds)[0], process.returncode
        except subprocess.TimeoutExpired:
            os.killpg(process.pid, 9)
            output, status = process.communicate()[0], None
    return status, output, time.monotonic() - begin


def run_alone(test, seconds):
    """'passed', 'skipped' or 'failed', and what was printed. Notes the time in `seconds`."""
    properties = test['properties']
    status, output, taken = run(test['command'], properties, float(properties.get('TIMEOUT', 1500)))
    seconds[test['name']] = round(taken, 1)
    if status == properties.get('SKIP_RETURN_CODE', 'none') or '[  SKIPPED ]' in output:
        return 'skipped', output
    wanted = properties.get('PASS_REGULAR_EXPRESSION')
    good = status == 0 if not wanted else any(re.search(w, output, re.DOTALL) for w in wanted)
    return ('passed' if good else 'failed'), output if status is not None else output + '\n(it ran too long)'


def run_batch(tests, seconds):
    """The cases of a program: {name: 'passed' or 'skipped'}; those that are not in it have to run alone. Notes each
    case's time in `seconds`."""
    by_case = {case_of(test): test['name'] for test in tests}
    chosen = '--gtest_filter=' + ':'.join(by_case)
    command = [chosen if word.startswith('--gtest_filter=') else word for word in tests[0]['command']]
    status, output, _ = run(command, tests[0]['properties'], BATCH_SECONDS)
    for case, milliseconds in re.findall(r'^\[ +(?:OK|FAILED) +\] (\S+?),? .*\((\d+) ms\)$', output, re.MULTILINE):
        if case in by_case:
            seconds[by_case[case]] = int(milliseconds) / 1000
    results = {}
    for mark, case in re.findall(r'^\[ +(OK|SKIPPED|FAILED) +\] ([^ ,]+)', output, re.MULTILINE):
        if case in by_case and mark != 'FAILED':
            results.setdefault(by_case[case], 'passed' if mark == 'OK' else 'skipped')
    for case in re.findall(r'^\[ +FAILED +\] ([^ ,]+)', output, re.MULTILINE):
        results.pop(by_case.get(case), None)
    # A process that ends badly after its last case, by a leak for one, leaves all of them in doubt.
    finished = re.search(r'^\[==========\] .* ran\.', output, re.MULTILINE)
    return results if status == 0 or (finished and len(results) < len(tests)) else {}


def batches_of(tests):
    """Lists of tests that share a process, and tests that have one of their own."""
    programs, alone = collections.defaultdict(list), []
    for test in tests:
        case = case_of(test)
        program = tuple(word for word in test['command'] if not word.startswith('--gtest_filter='))
        (alone if case is None or ALONE.search(test['name']) else programs[program]).append(test)
    batches = []
    for cases in programs.values():
        number = -(-len(cases) // CASES_A_BATCH)
        batches += [cases[i::number] for i in range(number)]  # so that long neighbours are shared out
    return batches, alone


def longest_first(items, seconds):
    """The lists and tests in the order in which they begin; `seconds` has what the last run measured, by test."""
    def expected(item):
        names = [test['name'] for test in (item if isinstance(item, list) else [item])]
        known = sum(seconds.get(name, 0) for name in names)
        return known or (30 if any(LONG.search(name) for name in names) else 1)
    return sorted(items, key=expected, reverse=True)


def main():
    if len(sys.argv) < 3:
        sys.exit(__doc__.split('\n\n', maxsplit=1)[0])
    preset, jobs, begin = sys.argv[1], int(sys.argv[2]), time.monotonic()
    os.environ.update(preset_environment(preset))
    tests = chosen_tests(preset, sys.argv[3:])
    batches, alone = batches_of(tests)
    measured = pathlib.Path(__file__).resolve().parent.parent / 'build' / preset / 'test_seconds.json'
    try:
        seconds = json.loads(measured.read_text())
    except (OSError, ValueError):  # no run, or one that was killed as it wrote
        seconds = {}
    print(f'{len(tests)} tests in {len(batches) + len(alone)} processes', flush=True)
    results, done = {}, 0
    failures = []

    def note(test, result, output):
        results[test['name']] = result
        if result == 'failed':
            failures.append(test['name'])
            print(f"\n***Failed {test['name']}\n{output}", flush=True)

    with concurrent.futures.ThreadPoolExecutor(jobs) as pool, concurrent.futures.ThreadPoolExecutor(1) as waiting:
        work = {}
        for item in longest_first(batches + alone, seconds):
            if isinstance(item, list):
                work[pool.submit(run_batch, item, seconds)] = item
            else:
                work[(waiting if WAITING.search(item['name']) else pool).submit(run_alone, item, seconds)] = item
        again = {}
        for future in concurrent.futures.as_completed(list(work)):
            item = work[future]
            if isinstance(item, dict):
                note(item, *future.result())
            else:
                found = future.result()
                results.update(found)
                again.update({pool.submit(run_alone, test, seconds): test for test in item if test['name'] not in found})
            done += 1
            if done % 20 == 0:
                print(f'{done} of {len(work)} processes, {time.monotonic() - begin:.0f} s', flush=True)
        for future in concurrent.futures.as_completed(list(again)):
            note(again[future], *future.result())
    measured.write_text(json.dumps(dict(sorted(seconds.items())), indent=0))
    print(f'{len(again)} of them also alone: ' + ' '.join(sorted(test['name'] for test in again.values())))
    skipped = sorted(name for name, result in results.items() if result == 'skipped')
    if skipped:
        print(f"{len(skipped)} skipped: {' '.join(skipped)}")
    passed = len(tests) - len(failures)
    for name in sorted(failures):
        print(f'***Failed {name}')
    print(f'{100 * passed // max(1, len(tests))}% tests passed, {len(failures)} tests failed out of {len(tests)}')
    taken, used = time.monotonic() - begin, resource.getrusage(resource.RUSAGE_CHILDREN)
    processor = used.ru_utime + used.ru_stime
    print(f'Total Test time (real) = {taken:.0f} sec')
    print(f'{processor:.0f} processor seconds, {100 * processor / (jobs * taken):.0f}% of {jobs} cores')
    print(f'{passed - len(skipped)} passed, {len(failures)} failed, {len(skipped)} skipped')
    sys.exit(1 if failures or not tests else 0)


if __name__ == '__main__':
    main()
