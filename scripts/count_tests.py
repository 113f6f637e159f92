#!/usr/bin/python3
"""Counts test cases: count_tests.py CTEST_JUNIT.xml RESULTS_FOLDER

A case is one gtest or rostest case. A test program that failed without reporting a failing case
(it crashed, timed out, or wrote no result) counts as one failure. Prints the failures, then
'N passed, M failed' as the last line.
"""
import pathlib
import sys
import xml.etree.ElementTree as ElementTree


def cases_in(folder):
    for path in sorted(pathlib.Path(folder).rglob("*.xml")):
        try:
            root = ElementTree.parse(path).getroot()
        except ElementTree.ParseError:
            yield path.stem, str(path), False
            continue
        for case in root.iter("testcase"):
            bad = case.find("failure") is not None or case.find("error") is not None
            yield path.stem, f"{case.get('classname')}.{case.get('name')}", not bad


def main():
    junit, folder = sys.argv[1:3]
    passed, failures, programs_with_failures = 0, [], set()
    for program, name, good in cases_in(folder):
        if good:
            passed += 1
        else:
            failures.append(name)
            programs_with_failures.add(program)
    try:
        programs = list(ElementTree.parse(junit).getroot().iter("testcase"))
    except (OSError, ElementTree.ParseError) as error:
        failures.append(f"{junit}: the run did not end ({error})")
        programs = []
    for program in programs:
        if program.get("status") == "run":
            continue
        name = program.get("name")
        if not any(known in name for known in programs_with_failures):
            failures.append(f"{name} ({program.get('status')})")
    if not programs and not failures:
        failures.append("no test program ran")
    for name in failures:
        print(f"FAILED {name}")
    print(f"{passed} passed, {len(failures)} failed")
    return 1 if failures else 0


if __name__ == "__main__":
    sys.exit(main())
