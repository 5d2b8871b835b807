#!/usr/bin/python3
"""Prints which lines of source/ and include/ the tests of a coverage build reached.

coverage.py ROOT BUILD: reads the counts that the instrumented programs left in
BUILD by gcov, joins those of a file that several programs share, and prints
the share of lines of each folder and the lines never reached of each file.
"""
import collections
import gzip
import json
import os
import subprocess
import sys
import tempfile


def reports(build):
    """Yields gcov's JSON of each object file that was run."""
    counts = [os.path.join(folder, name) for folder, _, names in os.walk(build)
              for name in names if name.endswith('.gcda')]
    for begin in range(0, len(counts), 20):
        with tempfile.TemporaryDirectory() as scratch:
            subprocess.run(['gcov', '--json-format', '--preserve-paths']
                           + counts[begin:begin + 20], cwd=scratch, check=True,
                           stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
            for name in os.listdir(scratch):
                with gzip.open(os.path.join(scratch, name)) as file:
                    yield json.load(file)


def lines_of(root, build):
    """{file: {line: count}} of the program's own files."""
    files = collections.defaultdict(lambda: collections.defaultdict(int))
    for report in reports(build):
        for file in report['files']:
            path = os.path.relpath(
                os.path.join(report['current_working_directory'], file['file']), root)
            if path.startswith(('source/', 'include/')):
                for line in file['lines']:
                    files[path][line['line_number']] += line['count']
    return files


def ranges(numbers):
    """'3-5, 9' for 3, 4, 5, 9."""
    result = []
    for number in sorted(numbers):
        if result and number == result[-1][1] + 1:
            result[-1][1] = number
        else:
            result.append([number, number])
    return ', '.join(str(a) if a == b else f'{a}-{b}' for a, b in result)


def main(root, build):
    files = lines_of(root, build)
    if not files:
        sys.exit(f"coverage.py: no program of '{build}' has left counts.")
    folders = collections.defaultdict(lambda: [0, 0])
    for path, lines in sorted(files.items()):
        missed = [number for number, count in lines.items() if count == 0]
        for key in (os.path.dirname(path), 'all'):
            folders[key][0] += len(lines) - len(missed)
            folders[key][1] += len(lines)
        if missed:
            print(f'{path}: {len(missed)} of {len(lines)} lines not reached: {ranges(missed)}')
    for key, (reached, total) in sorted(folders.items()):
        print(f'{100 * reached / total:6.1f} %  {reached:6} of {total:6} lines  {key}')


if __name__ == '__main__':
    main(os.path.realpath(sys.argv[1]), os.path.realpath(sys.argv[2]))
