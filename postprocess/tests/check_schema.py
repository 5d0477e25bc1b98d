"""Says of each case file whether a JSON schema accepts it, a line each: the file, then `valid` or the places of its mistakes.

Used as: check_schema.py SCHEMA CASE ...
"""

import json
import sys
import tomllib
from pathlib import Path

from jsonschema import Draft202012Validator


def main(schema: Path, cases: list[Path]) -> None:
    """Validates the schema, and cases by it."""
    rules = json.loads(schema.read_text())
    Draft202012Validator.check_schema(rules)
    validator = Draft202012Validator(rules)
    for case in cases:
        errors = validator.iter_errors(tomllib.loads(case.read_text()))
        places = sorted({f"{'.'.join(['$', *map(str, error.absolute_path)])}: {error.validator}" for error in errors})
        print(f"{case}\t{'; '.join(places) or 'valid'}")


if __name__ == "__main__":
    main(Path(sys.argv[1]), [Path(argument) for argument in sys.argv[2:]])
