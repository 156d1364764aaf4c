# SPDX-License-Identifier: GPL-3.0-or-later
"""The part of JSON Schema that cli/schema uses; an unknown keyword is an error, so nothing goes unchecked."""

import re

TYPES = {
    "object": dict,
    "array": list,
    "string": str,
    "boolean": bool,
    "integer": int,
    "number": (int, float),
    "null": type(None),
}
IGNORED = {"$schema", "$id", "title", "description", "$defs"}


def is_type(value, name):
    if isinstance(value, bool):
        return name == "boolean"
    return isinstance(value, TYPES[name])


def problems(value, schema, root=None, where="$"):
    """Yields a line for every rule that value breaks."""
    root = root or schema
    for keyword, rule in schema.items():
        if keyword in IGNORED:
            continue
        check = globals().get("check_" + keyword.replace("$", ""))
        if check is None:
            yield f"{where}: the schema uses {keyword}, which this checker doesn't know"
            continue
        yield from check(value, rule, schema, root, where)


def check_ref(value, rule, _schema, root, where):
    target = root
    for part in rule.lstrip("#/").split("/"):
        target = target[part]
    yield from problems(value, target, root, where)


def check_type(value, rule, _schema, _root, where):
    names = rule if isinstance(rule, list) else [rule]
    if not any(is_type(value, name) for name in names):
        yield f"{where}: not of type {rule}: {value!r}"


def check_const(value, rule, _schema, _root, where):
    if value != rule:
        yield f"{where}: not {rule!r}: {value!r}"


def check_enum(value, rule, _schema, _root, where):
    if value not in rule:
        yield f"{where}: none of {rule!r}: {value!r}"


def check_oneOf(value, rule, _schema, root, where):
    if sum(not list(problems(value, option, root, where)) for option in rule) != 1:
        yield f"{where}: not just one of {len(rule)} choices"


def check_pattern(value, rule, _schema, _root, where):
    if isinstance(value, str) and not re.search(rule, value):
        yield f"{where}: doesn't match {rule}: {value!r}"


def check_minimum(value, rule, _schema, _root, where):
    if is_type(value, "number") and value < rule:
        yield f"{where}: below {rule}: {value!r}"


def check_exclusiveMinimum(value, rule, _schema, _root, where):
    if is_type(value, "number") and value <= rule:
        yield f"{where}: not above {rule}: {value!r}"


def check_maximum(value, rule, _schema, _root, where):
    if is_type(value, "number") and value > rule:
        yield f"{where}: above {rule}: {value!r}"


def check_minItems(value, rule, _schema, _root, where):
    if isinstance(value, list) and len(value) < rule:
        yield f"{where}: fewer than {rule} items"


def check_maxItems(value, rule, _schema, _root, where):
    if isinstance(value, list) and len(value) > rule:
        yield f"{where}: more than {rule} items"


def check_required(value, rule, _schema, _root, where):
    for name in rule:
        if isinstance(value, dict) and name not in value:
            yield f"{where}: lacks {name}"


def check_dependentRequired(value, rule, _schema, _root, where):
    for name, needed in rule.items():
        for other in needed:
            if isinstance(value, dict) and name in value and other not in value:
                yield f"{where}: has {name} but lacks {other}"


def check_properties(value, rule, _schema, root, where):
    if isinstance(value, dict):
        for name, sub in rule.items():
            if name in value:
                yield from problems(value[name], sub, root, f"{where}.{name}")


def check_additionalProperties(value, rule, schema, root, where):
    if not isinstance(value, dict):
        return
    for name in value.keys() - schema.get("properties", {}).keys():
        if rule is False:
            yield f"{where}: unexpected {name}"
        elif isinstance(rule, dict):
            yield from problems(value[name], rule, root, f"{where}.{name}")


def check_items(value, rule, _schema, root, where):
    if isinstance(value, list):
        for index, item in enumerate(value):
            yield from problems(item, rule, root, f"{where}[{index}]")
