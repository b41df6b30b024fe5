#!/usr/bin/env python3
"""Prints the tests that failed and, last, "N passed, N failed". Exit status 1 if a test failed or none ran.

catkin_test_results counts gtest and rostest files twice, so the cases are counted here, in the result files:
- each <testcase> of gtest, rostest nodes, pytest and roslaunch checks is one test;
- a rostest-*.xml tells only whether its nodes ran: its cases count when they failed (crash, time limit, missing node);
- each report of a sanitizer, of any process that a test has started, is one failure;
- catkin writes MISSING-*.xml in place of a result file that a test did not write (it crashed): one failure.
"""
import argparse
import pathlib
import sys
import xml.etree.ElementTree as ElementTree

MESSAGE_LINES = 40


def failure_text(case, suite_output):
    """The failure of one <testcase>, None where it passed; suite_output: where roslaunch's check tells the reason."""
    failures = [*case.findall("failure"), *case.findall("error")]
    if not failures:
        return None
    # rosunit repeats the message in the text; gtest and pytest have the longer text
    texts = [max((failure.text or "").strip(), failure.get("message") or "", key=len) for failure in failures]
    return "\n".join([*texts, suite_output])


def test_output(log, result_name):
    """The last lines that a test printed: its section in ctest's log, by the name of its result file."""
    test = "_" + result_name[len("MISSING-"):-len(".xml")].replace("test-", "test_", 1)
    for section in log.split(" Start "):
        name, _, output = section.partition("\n")
        if name.endswith((test, test + ".test")):
            return "\n".join(output.splitlines()[-MESSAGE_LINES + 1:])
    return ""


def read_results(path, log):
    """(number passed, number skipped, [(name, failure text)]) of one result file; log: what ctest printed."""
    try:
        root = ElementTree.parse(path).getroot()
    except ElementTree.ParseError as error:
        return 0, 0, [(path.name, f"unreadable result file: {error}")]
    if path.name.startswith("MISSING-"):
        text = "the test ended without a result: it crashed or could not start\n" + test_output(log, path.name)
        return 0, 0, [(path.name, text)]
    suite_output = root.findtext("system-out", "") if path.name.startswith("roslaunch-check") else ""
    passed, skipped, failed = 0, 0, []
    for case in root.iter("testcase"):
        text = failure_text(case, suite_output)
        if text is not None:
            failed.append((f"{case.get('classname', path.stem)}.{case.get('name')}", text))
        elif case.find("skipped") is not None or case.get("status") == "notrun":
            skipped += 1
        else:
            passed += 1
    if path.name.startswith("rostest-"):
        passed = skipped = 0
    return passed, skipped, failed


def print_failure(name, text):
    lines = text.splitlines()
    print(f"FAILED {name}")
    for line in lines[:MESSAGE_LINES]:
        print(f"    {line}")
    if len(lines) > MESSAGE_LINES:
        print(f"    ... {len(lines) - MESSAGE_LINES} more lines")


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("results", type=pathlib.Path, help="folder with the result files")
    parser.add_argument("--ctest-status", type=int, default=0, help="exit status of ctest")
    parser.add_argument("--sanitizer-reports", type=pathlib.Path, help="folder with a file for each defect found")
    parser.add_argument("--log", type=pathlib.Path, help="what ctest printed")
    options = parser.parse_args()

    log = options.log.read_text(errors="replace") if options.log else ""
    results = [read_results(path, log) for path in sorted(options.results.rglob("*.xml"))]
    passed = sum(result[0] for result in results)
    skipped = sum(result[1] for result in results)
    failed = [failure for result in results for failure in result[2]]
    if options.sanitizer_reports:
        failed += [(path.name, path.read_text(errors="replace")) for path in sorted(options.sanitizer_reports.iterdir())]
    if options.ctest_status != 0 and not failed:
        failed.append(("ctest", f"exit status {options.ctest_status}, though no result file tells of a failure"))
    if passed == 0 and not failed:
        failed.append(("scripts/test", "no test ran"))

    for name, text in failed:
        print_failure(name, text)
    if failed and options.log:
        print(f"whole output: {options.log}")
    if skipped:
        print(f"{skipped} skipped")
    print(f"{passed} passed, {len(failed)} failed")
    return 1 if failed else 0


if __name__ == "__main__":
    sys.exit(main())
