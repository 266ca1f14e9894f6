"""Rewrites the metadata of an ONNX file without the onnx package.

A file is one protobuf message, ``ModelProto``; entries of its field 14 are metadata, each a key (1) and a value (2).
"""

from __future__ import annotations

METADATA_FIELD = 14


def with_metadata(model, metadata):
    """The bytes of ``model`` with this metadata instead of its own."""
    kept = b"".join(whole for field, whole, _ in _fields(model) if field != METADATA_FIELD)
    entries = (_text(1, key) + _text(2, value) for key, value in metadata.items())
    return kept + b"".join(_delimited(METADATA_FIELD, entry) for entry in entries)


def metadata_of(model):
    """Key -> value."""
    bodies = [body for field, _, body in _fields(model) if field == METADATA_FIELD]
    entries = [{field: text for field, _, text in _fields(body)} for body in bodies]
    return {entry[1].decode(): entry[2].decode() for entry in entries}


def _fields(message):
    """(field number, whole bytes, body) of every field of a message."""
    at = 0
    while at < len(message):
        start = at
        tag, at = _varint(message, at)
        length, body_at = _varint(message, at)
        assert tag & 7 in {0, 2}, "only numbers and texts occur at the top of an ONNX file"
        at = body_at + length if tag & 7 == 2 else body_at
        yield tag >> 3, message[start:at], message[body_at:at]


def _varint(message, at):
    value = shift = 0
    while True:
        byte = message[at]
        value, shift, at = value | (byte & 0x7F) << shift, shift + 7, at + 1
        if byte < 0x80:
            return value, at


def _encoded(value):
    out = b""
    while value >= 0x80:
        out, value = out + bytes([value & 0x7F | 0x80]), value >> 7
    return out + bytes([value])


def _delimited(field, body):
    return _encoded(field << 3 | 2) + _encoded(len(body)) + body


def _text(field, text):
    return _delimited(field, text.encode())
