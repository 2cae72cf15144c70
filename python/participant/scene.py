"""Reading a scene strictly: every key must be known, every number carries its unit, every complaint names the key."""
from __future__ import annotations

import math
import re
from typing import Any, Iterator

import numpy as np

from talus_participant import _native
from talus_participant.errors import ConfigError

_QUANTITY = re.compile(r"\s*([-+]?(?:\d+\.?\d*|\.\d+)(?:[eE][-+]?\d+)?)\s*(.*?)\s*")


def read_scene(path: str) -> Section:
    """The scene in the file `path`, laid over the scenes it extends. Raises ConfigError."""
    return Section(_native.read_scene(path), "", str(path))


class Section:
    """A map of the scene. Reading a key takes it; `finish` complains about the keys that nobody took."""

    def __init__(self, entries: Any, key_path: str, file: str):
        self._key_path, self._file = key_path, file
        if not isinstance(entries, dict):
            raise self.error("", f"expects a map of keys, got '{entries}'")
        self._entries, self._taken = entries, set()

    def __contains__(self, key: str) -> bool:
        return key in self._entries

    def error(self, key: str, message: str) -> ConfigError:
        """An error about a key of this section."""
        place = ".".join(part for part in (self._key_path, key) if part)
        return ConfigError(": ".join(part for part in (self._file, place, message) if part))

    def section(self, key: str) -> Section:
        """The section below `key`."""
        return Section(self._take(key), f"{self._key_path}.{key}".lstrip("."), self._file)

    def sections(self) -> Iterator[tuple[str, Section]]:
        """The named sections of a map such as `parts`, in the order of the file."""
        for key in self._entries:
            yield key, self.section(key)

    def list(self, key: str) -> list[Section]:
        """The entries of a list of sections."""
        return [Section(item, f"{self._key_path}.{key}[{i}]".lstrip("."), self._file)
                for i, item in enumerate(self._list(key))]

    def number(self, key: str, unit: str, at_least: float = -math.inf) -> float:
        """A quantity in the SI unit `unit` ("" for a plain number), not below `at_least`."""
        value = self._number(key, self._take(key), unit)
        if value < at_least:
            raise self.error(key, f"must be at least {at_least:g} {unit}, but is {value:g} {unit}")
        return value

    def numbers(self, key: str, unit: str, count: int) -> np.ndarray:
        """A list of `count` quantities, such as a point."""
        items = self._list(key)
        if len(items) != count:
            raise self.error(key, f"expects {count} numbers, got {len(items)}")
        return np.array([self._number(key, item, unit) for item in items])

    def text(self, key: str) -> str:
        """A text."""
        value = self._take(key)
        if not isinstance(value, str):
            raise self.error(key, f"expects a text, got '{value}'")
        return value

    def texts(self, key: str) -> list[str]:
        """A list of texts."""
        return [str(item) for item in self._list(key)]

    def ignore(self, *keys: str) -> None:
        """Keys that are another program's business."""
        self._taken.update(keys)

    def finish(self) -> None:
        """Raises ConfigError where the section has a key that was not taken."""
        unknown = [key for key in self._entries if key not in self._taken]
        if unknown:
            known = ", ".join(sorted(self._taken))
            raise self.error(unknown[0], f"is a key this solver does not know; it knows {known or 'none here'}")

    def _take(self, key: str) -> Any:
        self._taken.add(key)
        if key not in self._entries:
            raise self.error(key, "is missing")
        return self._entries[key]

    def _list(self, key: str) -> Any:
        items = self._take(key)
        if not isinstance(items, list):
            raise self.error(key, f"expects a list, got '{items}'")
        return items

    def _number(self, key: str, written: Any, unit: str) -> float:
        match = _QUANTITY.fullmatch(written) if isinstance(written, str) else None
        if match is None:
            raise self.error(key, f"expects a number, got '{written}'")
        value, given = float(match.group(1)), match.group(2)
        try:
            return _native.convert(value, given, unit) if given else value
        except ConfigError as error:
            raise self.error(key, str(error)) from None
