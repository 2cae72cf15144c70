"""Writes one well-formed message of each kind, as CBOR (RFC 8949), for the fuzzer to change: message_seeds.py FOLDER"""

import pathlib
import struct
import sys


def head(major, number):
    if number < 24:
        return bytes([major << 5 | number])
    return bytes([major << 5 | 26]) + struct.pack(">I", number)


def cbor(value):
    if isinstance(value, bool):
        return bytes([0xF5 if value else 0xF4])
    if isinstance(value, int):
        return head(0, value) if value >= 0 else head(1, -1 - value)
    if isinstance(value, float):
        return b"\xfb" + struct.pack(">d", value)
    if isinstance(value, bytes):
        return head(2, len(value)) + value
    if isinstance(value, str):
        return head(3, len(value.encode())) + value.encode()
    if isinstance(value, list):
        return head(4, len(value)) + b"".join(map(cbor, value))
    return head(5, len(value)) + b"".join(cbor(k) + cbor(v) for k, v in value.items())


def doubles(*values):
    return struct.pack(f"={len(values)}d", *values)


surface = {
    "positions": doubles(0, 0, 0, 1, 0, 0, 0, 1, 0),
    "segments": struct.pack("=2i", 0, 1),
    "triangles": struct.pack("=3i", 0, 1, 2),
    "parts": [{"name": "net", "material": "steel", "wire_radius": 0.01, "segments": [0, 1], "triangles": [0, 1]}],
    "node_masses": doubles(1, 1, float("inf")),
}
declaration = {
    "program": "solver 1", "step": 1e-5, "insists_on_step": False, "free_velocity": False, "light_boundary": True,
    "checkpoints": True, "force_use": 0,
    "limits": [{"name": "wave", "seconds": 1e-4, "stability": True, "reason": "element 3"}],
    "effects": [{"name": "friction", "present": True, "reason": "given", "key": "k", "ledger_line": "a.b_J", "may_hold": True, "limit": ""}],
    "outputs": {
        "probes": [{"name": "centre.x_m", "watches": "node 3"}],
        "ledger": [{"name": "a.b_J", "kind": 1}],
        "groups": [{"name": "net", "kind": 2, "nodes": 2, "cells": struct.pack("=2q", 0, 1),
                    "fields": [{"name": "force", "unit": "N", "components": 1, "location": 1}]}],
        "tables": [{"name": "below", "columns": ["time_s"], "capacity": 5, "kind": 0}],
        "facts": [{"name": "rock.spheres", "value": 16.0}],
    },
    "warnings": ["something"],
}
failures = [
    {"message": "gone"},
    {"message": "full", "machine": True},
    {"message": "wrong", "complaints": [{"file": "a.yaml", "line": 3, "column": 1, "key_path": "time.end", "message": "missing"}]},
    {"message": "nan", "numerical": {"what": "not finite", "entity": "node 3", "step": 4, "time": 0.1, "value": doubles(1.5),
                                     "last_output_time": 0.05}},
]

folder = pathlib.Path(sys.argv[1])
for number, (kind, message) in enumerate([(0, surface), (1, declaration)] + [(2, failure) for failure in failures]):
    (folder / f"message_{number}").write_bytes(bytes([kind]) + cbor(message))
