"""Checks files with `refines` and says what came out, with counterexamples by name.

Reads FDR's JSON as a user of FDR would: the program is found on the PATH, keys are FDR's.
"""
import json
import subprocess
import sys


class Report:
    def __init__(self, document):
        self.document = document
        self.names = {int(number): name for number, name in document["event_map"].items()}

    def events(self, numbers):
        return "<" + ", ".join(self.names[n] for n in numbers) + ">"

    def ending(self, behaviour):
        kind = behaviour["type"]
        if kind == "trace":
            error = behaviour["error_event"]
            return "then " + self.names[error] if error != 0 else "then nothing"
        if kind == "min_acceptance":
            offers = sorted(self.names[n] for n in behaviour["acceptance"])
            return "offering {" + ", ".join(offers) + "}"
        if kind == "loop":
            return "repeating from %d" % behaviour["loop_start"]
        return kind

    def show(self, title, behaviour, depth):
        name = behaviour.get("machine_name", "(unnamed)")
        print("  " * depth + "%s %s %s %s" % (
            title, name, self.events(behaviour["trace"]), self.ending(behaviour)))
        for child in behaviour.get("child_behaviours", []):
            self.show("component", child, depth + 1)

    def run(self):
        for error in self.document["errors"]:
            print("error " + error)
        for result in self.document["results"]:
            if result["errors"]:
                print("%s: %s" % (result["assertion_string"], result["errors"]))
                continue
            word = "Passed" if result["result"] else "Failed"
            print("%s: %s, %d states" % (
                result["assertion_string"], word, result["visited_states"]))
            for counterexample in result["counterexamples"]:
                print("  " + counterexample["type"])
                for key in ("specification_behaviour", "implementation_behaviour"):
                    if key in counterexample:
                        self.show(key.split("_")[0], counterexample[key], 2)
        for printed in self.document["print_statement_results"]:
            print("%s = %s" % (printed["print_statement"], printed["result"]))


def main():
    command = ["refines", "--divide", "--format", "json", "--quiet"] + sys.argv[1:]
    output = subprocess.run(command, stdout=subprocess.PIPE, check=True).stdout
    for line in output.decode("utf-8").splitlines():
        Report(json.loads(line)).run()


main()
