"""Files: input of bounded size, output that is either complete or not there."""

from __future__ import annotations

import contextlib
import io
import os
import secrets
import stat
import sys
from collections.abc import Callable, Iterator
from numbers import Integral
from pathlib import Path
from typing import BinaryIO, Final

from exactpt.brief import in_brief
from exactpt.errors import InputError

if sys.platform == "win32":
    import msvcrt
else:
    import fcntl

MAX_BYTES: Final = 100_000_000
"""Maximum size of a file that is read, unless another limit is given."""
CHUNK: Final = 1 << 20
"""Number of bytes read at a time: memory is allocated for what a file has, not for the limit."""


def read_text(path: Path, most: int | None = None) -> str:
    """Return the text of a file in UTF-8, with or without a byte order mark; see `read_bytes`."""
    try:
        return read_bytes(path, most).decode("utf-8-sig")
    except UnicodeDecodeError:
        raise InputError(f"{path}: cannot be read: not UTF-8") from None


def read_bytes(path: Path, most: int | None = None) -> bytes:
    """Return the content of a file, a pipe or a terminal.

    Args:
        path: the file.
        most: maximum number of bytes; by default `MAX_BYTES`.

    Raises:
        InputError: if it cannot be read, is a device, or is larger than that, or the maximum is
            not a number from 0 on. A regular file is refused by its size, before anything is read.
    """
    limit = MAX_BYTES if most is None else most
    if not isinstance(limit, Integral) or limit < 0:
        raise InputError(f"max_bytes: not a number of bytes: {in_brief(limit)}")
    content = io.BytesIO()
    try:
        with path.open("rb") as file:
            kind = os.fstat(file.fileno())
            if stat.S_ISBLK(kind.st_mode) or (stat.S_ISCHR(kind.st_mode) and not file.isatty()):
                raise InputError(f"{path}: cannot be read: a device")
            if kind.st_size <= limit:
                while content.tell() <= limit and (part := file.read(CHUNK)):
                    content.write(part)
    except InputError:
        raise
    except (OSError, ValueError) as error:  # the latter: a null character in the path
        reason = error.strerror if isinstance(error, OSError) else error
        raise InputError(f"{path}: cannot be read: {reason}") from None
    if max(kind.st_size, content.tell()) > limit:
        raise InputError(
            f"{path}: more than {limit} bytes: allow more by --max-bytes (in Python max_bytes)"
        )
    return content.getvalue()


def write_atomically(path: Path, content: str | bytes) -> None:
    """Write a file atomically, see `writing`.

    Raises:
        InputError: if the file cannot be written.
    """
    with writing(path) as write:
        write(content)


def create(path: Path, content: bytes) -> BinaryIO:
    """Create a file that begins with some bytes; return it, open for reading and writing.

    It appears with all of these bytes or not at all, whatever ends the process. What has this name
    already, be it a file, a link or a pipe, is left alone.

    Raises:
        InputError: if the name is taken, or the file cannot be written.
    """
    with _refusing(path):
        # Windows does not rename an open file: there, an interrupted creation leaves a part of it.
        in_place = sys.platform == "win32"
        file: BinaryIO = open(path, "x+b") if in_place else _open_beside(path, None)  # noqa: SIM115
        try:
            file.write(content)
            file.flush()
            os.fsync(file.fileno())
            if not in_place:
                _move(file.name, path)
        except BaseException:
            file.close()
            with contextlib.suppress(OSError):
                os.unlink(file.name)
            raise
    return file


def open_regular(path: Path, *, writable: bool) -> BinaryIO:
    """Open a file that exists, at its beginning: a regular one, and no link to one.

    Raises:
        InputError: if it is a link, a folder, a pipe or a device, or cannot be opened.
    """
    flags = os.O_RDWR if writable else os.O_RDONLY
    for name in ("O_NOFOLLOW", "O_NONBLOCK", "O_BINARY"):  # each is missing on some systems
        flags |= getattr(os, name, 0)
    if path.is_symlink():
        raise InputError(f"{path}: a link: move it away, or choose another name")
    try:
        descriptor = os.open(path, flags)
    except OSError as error:
        raise InputError(f"{path}: cannot be opened: {error.strerror}") from None
    if not stat.S_ISREG(os.fstat(descriptor).st_mode):
        os.close(descriptor)
        raise InputError(f"{path}: not a file: move it away, or choose another name")
    return open(descriptor, "r+b" if writable else "rb")


def is_at(file: BinaryIO, path: Path) -> bool:
    """Return True if an open file still has this name."""
    try:
        return os.path.samestat(os.fstat(file.fileno()), os.lstat(path))
    except OSError:
        return False


@contextlib.contextmanager
def writing(path: Path, *, new: bool = False) -> Iterator[Callable[[str | bytes], None]]:
    """Give a function that writes to a temporary file, which replaces ``path`` at the end.

    The temporary file is in the same folder. After an exception inside the context it is
    removed, and an older file is unchanged. A symbolic link stays, its target is replaced;
    permissions are kept. A pipe or a device is written to directly, and so is a file that a
    process has open (``/dev/stdout``).

    Any number of threads may do this at the same time.

    Args:
        path: the file.
        new: whether nothing is replaced: the name must not be taken, neither now nor at the end.

    Raises:
        InputError: if the file cannot be written, or must be new and is there.
    """
    with _refusing(path):
        if new and os.path.lexists(path):
            raise FileExistsError
        special = any(path.absolute().is_relative_to(folder) for folder in ("/dev", "/proc"))
        direct = path.exists() and (special or not path.is_file())
        target = path if direct or new else path.resolve()
        mode = stat.S_IMODE(target.stat().st_mode) if target.exists() else None
        file = path.open("wb") if direct else _open_beside(target, mode)

    def write(content: str | bytes) -> None:
        with _refusing(path):
            file.write(content.encode() if isinstance(content, str) else content)

    try:
        yield write
        with _refusing(path):
            if direct:
                file.close()
            else:
                _put_in_place(file, target, mode, new=new)
    except BaseException:
        with contextlib.suppress(OSError):
            file.close()
        if not direct:
            with contextlib.suppress(OSError):
                os.unlink(file.name)
        raise


@contextlib.contextmanager
def _refusing(path: Path) -> Iterator[None]:
    try:
        yield
    except FileExistsError:
        raise InputError(f"{path}: it exists: remove it, or choose another name") from None
    except OSError as error:
        raise InputError(f"{path}: cannot be written: {error.strerror}") from None


def _open_beside(target: Path, mode: int | None) -> BinaryIO:
    """Return a new file in the same folder, with permissions no wider than the old file's."""
    name = target.with_name(f".exactpt-{secrets.token_hex(8)}")
    allowed = 0o666 if mode is None else mode & 0o666 | stat.S_IWUSR
    return open(name, "x+b", opener=lambda path, flags: os.open(path, flags, allowed))


def _put_in_place(file: BinaryIO, target: Path, mode: int | None, *, new: bool) -> None:
    if mode is not None:
        os.chmod(file.name, mode)
    file.flush()
    os.fsync(file.fileno())
    file.close()
    if new:
        _move(file.name, target)
    else:
        os.replace(file.name, target)


def _move(name: str, path: Path) -> None:
    """Give a file another name, which must not be taken.

    Raises:
        FileExistsError: if it is.
    """
    try:
        os.link(name, path)
    except FileExistsError:
        raise
    except OSError:  # a file system without hard links: there is a moment between the two steps
        if os.path.lexists(path):
            raise FileExistsError from None
        os.rename(name, path)
    else:
        os.unlink(name)


def lock(file: BinaryIO) -> bool:
    """Lock a file until it is closed; false if another process has locked it."""
    try:
        if sys.platform == "win32":
            msvcrt.locking(file.fileno(), msvcrt.LK_NBLCK, 1)
        else:
            fcntl.flock(file, fcntl.LOCK_EX | fcntl.LOCK_NB)
    except OSError:
        return False
    return True
