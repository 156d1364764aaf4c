#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""The networks in tests/art/network are what cli/schema/network.schema.json says; what breaks it is refused."""

import copy
import json
import pathlib
import sys

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "tests" / "tools"))
import json_schema  # noqa: E402


def broken(network):
    """The network with one rule broken each time."""
    def with_change(change):
        other = copy.deepcopy(network)
        change(other)
        return other

    yield with_change(lambda n: n.pop("width"))
    yield with_change(lambda n: n.update(more=1))
    yield with_change(lambda n: n.update(schema="fetexc-network/2"))
    yield with_change(lambda n: n.update(height=0))
    yield with_change(lambda n: n["curves"][0].pop("start"))
    yield with_change(lambda n: n["curves"][0]["start"].append(1))
    yield with_change(lambda n: n["curves"][0].update(closed=1))
    yield with_change(lambda n: n["curves"][0].update(left=[2, 0, 0]))
    yield with_change(lambda n: n["curves"][0]["segments"].append([1, 2, 3, 4, 5, 6, 7, 8]))
    for profile in ({"preset": "crease"}, {"preset": "hill", "width": 1}, {"heights": [[0, 1]]}, {},
                    {"preset": "crease", "width": 1, "heights": [[0, 0], [1, 1]]},
                    {"preset": "crease", "width": 0}, {"preset": "seam", "width": 1, "color": [0, 2, 0]}):
        yield with_change(lambda n, p=profile: n.update(profiles={"p": p}))


def main():
    schema = json.loads((ROOT / "cli" / "schema" / "network.schema.json").read_text(encoding="utf-8"))
    files = sorted((ROOT / "tests" / "art" / "network").glob("*.json"))
    failures = [] if files else ["no network"]
    for file in files:
        network = json.loads(file.read_text(encoding="utf-8"))
        failures += [f"{file.name}: {line}" for line in json_schema.problems(network, schema)]
        failures += [f"{file.name}: change {k} isn't refused" for k, other in enumerate(broken(network))
                     if not list(json_schema.problems(other, schema))]
    print("\n".join(failures))
    print(f"{len(files)} networks, {len(failures)} failed")
    return 1 if failures else 0


if __name__ == "__main__":
    sys.exit(main())
