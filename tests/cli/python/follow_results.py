"""Follows a run of `refines` assertion by assertion: each line of framed JSON is a document."""
import json
import subprocess
import sys


def main():
    command = ["refines", "--format=framed_json", "--quiet"] + sys.argv[1:]
    failed = 0
    with subprocess.Popen(command, stdout=subprocess.PIPE) as process:
        for line in process.stdout:
            document = json.loads(line.decode("utf-8"))
            for result in document["results"]:
                holds = not result["errors"] and result["result"] == 1
                failed += 0 if holds else 1
                print("%s %s" % ("ok" if holds else "NOT OK", result["assertion_string"]))
            for printed in document["print_statement_results"]:
                print("print %s at %s" % (printed["result"], printed["location"]))
    print("%d of the assertions do not hold" % failed)
    return process.returncode


sys.exit(main())
