"""Programs as texts and as files of texts."""
import os

from ._combiner import Error

_LONGEST = 1 << 26  # bytes, more than any reader takes


def source_of(name, value):
    """A program that is neither a State nor a Program: its text and None, or None and its file's name.

    A str is a text if it has several lines or an equals sign, a semicolon or a brace, which programs have and names of
    files mostly do not; if a file has that name all the same, it is that file.
    """
    if isinstance(value, bytes):
        return value, None
    if isinstance(value, os.PathLike):
        value = os.fspath(value)
        if isinstance(value, str):
            return None, value
    if not isinstance(value, str):
        raise TypeError(f"{name} is {type(value).__name__}; expected a State, a Program, the path of a file, or the text of a program")
    if "\n" in value or "\0" in value or not value:
        return value, None
    is_text = any(mark in value for mark in "=;{}") and not os.path.exists(value)
    return (value, None) if is_text else (None, value)


def read(name, value):
    """The text of a program, and the name of the file that it was read from."""
    text, path = source_of(name, value)
    if path is None:
        return text, None
    if not os.path.isfile(path):
        raise Error(f"{name} is {path!r}, which is not a file; expected the path of a file, or the text of a program")
    try:
        with open(path, "rb") as file:
            return file.read(_LONGEST), path
    except OSError as wrong:
        raise Error(f"{path}: cannot be read: {wrong.strerror}") from None
