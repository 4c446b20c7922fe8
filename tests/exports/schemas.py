"""Schemas of other people, with the faults of one of them mended by name."""

import json

import jsonschema

# The draft of LIF 2.0 (branch dev/V2 @d06d520) is no JSON. Each fault: where, what stands there, what is meant.
LIF_2_FAULTS = [
    ("line 280: a comma after the last entry", '        "vehicleTypeId",\n      ],\n      "properties"', '        "vehicleTypeId"\n      ],\n      "properties"'),
    ("line 289: bare quotes in a description", 'set to "true".  If *rotationAllowed* is "false", rotate', r'set to \"true\".  If *rotationAllowed* is \"false\", rotate'),
    ("line 301: bare quotes in a description", None, None),
    ('line 518: no comma before "corridor"', '    }\n    "corridor":{', '    },\n    "corridor":{'),
    ("line 539: the last brace is missing", None, None),
]


def read(path):
    """A schema, and the faults that were mended in it."""
    text = path.read_text(encoding="utf-8")
    if path.parent.name != "lif-official-2.0-dev":
        return json.loads(text), []
    return json.loads(mended(text)), [where for where, _, _ in LIF_2_FAULTS]


def mended(text):
    """The draft of LIF 2.0 as JSON. A fault that is not there is an error: this list has to follow the draft."""
    for where, wrong, meant in LIF_2_FAULTS:
        if wrong and text.count(wrong) != 1:
            raise ValueError(f"{where}: is there {text.count(wrong)} times")
        text = text.replace(wrong, meant) if wrong else text
    lines = text.rstrip().split("\n")
    head, description = lines[300].split('"description": "')
    lines[300] = f'{head}"description": "' + description[:-1].replace('"', r"\"") + '"'
    return "\n".join(lines) + "\n}"


def problems(document, schema):
    """What of a document does not fit a schema."""
    validator = jsonschema.validators.validator_for(schema, jsonschema.Draft7Validator)
    return [f"{error.json_path}: {error.message[:200]}" for error in validator(schema).iter_errors(document)][:5]
