"""A file object for HDF5 whose changes arrive all at once or not at all.

HDF5 changes its index in place: a process that is killed meanwhile leaves a file that
nobody can open. Here a change below the old end of the file waits in memory, new data
behind the old end is written at once (nothing refers to it yet), and ``commit`` puts
the waiting pages into a journal beside the file before it touches the file itself.
A kill before the journal is complete leaves the old state, a kill after it leaves a
journal that the next reader or writer applies.
"""

import hashlib
import os
import struct
from pathlib import Path
from types import TracebackType
from typing import BinaryIO, Self

_PAGE = 4096
_MAGIC = b"pestle-journal-1"
_HEAD = struct.Struct("<16sQQ")  # magic, size of the finished file, number of pages
_PIECE = struct.Struct("<QI")  # page number, length of its part below the old end
_DIGEST = hashlib.sha256().digest_size


def journal_path(path: Path) -> Path:
    """Path of the journal that belongs to the file at `path`."""
    return path.with_name(path.name + ".journal")


def _read_journal(path: Path) -> tuple[int, dict[int, bytes]] | None:
    """Final size [bytes] and waiting pages, None without a complete journal."""
    try:
        data = journal_path(path).read_bytes()
    except FileNotFoundError:
        return None
    body, digest = data[:-_DIGEST], data[-_DIGEST:]
    if len(body) < _HEAD.size or hashlib.sha256(body).digest() != digest:
        return None
    magic, size, count = _HEAD.unpack_from(body)
    if magic != _MAGIC:
        return None
    pages, start = {}, _HEAD.size
    for _ in range(count):
        number, length = _PIECE.unpack_from(body, start)
        start += _PIECE.size
        pages[number] = body[start : start + length]
        start += length
    return size, pages


def _apply(file: BinaryIO, size: int, pages: dict[int, bytes]) -> None:
    """Write the pages into the file and set its size [bytes]."""
    for number in sorted(pages):
        file.seek(number * _PAGE)
        file.write(pages[number])
    file.truncate(size)
    file.flush()
    os.fsync(file.fileno())


class SafeFile:
    """Open a file for changes that become visible together on ``commit``.

    Parameters
    ----------
    path : Path
        An existing file (may be empty).
    write : bool
        Whether changes are allowed. A reader sees a waiting journal as if it had
        been applied and leaves both files alone.
    """

    def __init__(self, path: Path, *, write: bool) -> None:
        self.path = path
        self._file: BinaryIO = path.open("r+b" if write else "rb")
        self._writable = write
        self._pages: dict[int, bytearray] = {}
        self._position = 0
        waiting = _read_journal(path)
        if waiting and write:
            _apply(self._file, *waiting)
            journal_path(path).unlink()
        self._end = self._size = self._file.seek(0, os.SEEK_END)
        if waiting and not write:
            self._size = waiting[0]
            self._end = max(self._end, self._size)
            self._pages = {n: bytearray(page) for n, page in waiting[1].items()}

    def __enter__(self) -> Self:
        return self

    def __exit__(
        self,
        kind: type[BaseException] | None,
        error: BaseException | None,
        trace: TracebackType | None,
    ) -> None:
        self.close()

    def close(self) -> None:
        """Close the file; what was not committed is forgotten."""
        if self._writable and not self._file.closed:
            self._file.truncate(self._end)
        self._file.close()

    def tell(self) -> int:
        """Return the position [bytes]."""
        return self._position

    def seek(self, offset: int, whence: int = os.SEEK_SET) -> int:
        """Move to a position [bytes] from the start, here or the end."""
        base = {os.SEEK_SET: 0, os.SEEK_CUR: self._position, os.SEEK_END: self._size}
        self._position = base[whence] + offset
        return self._position

    def read(self, size: int = -1) -> bytes:
        """Return up to `size` bytes from here, waiting changes included."""
        left = max(self._size - self._position, 0)
        count = left if size < 0 else min(size, left)
        self._file.seek(self._position)
        data = bytearray(self._file.read(count).ljust(count, b"\0"))
        for number in self._pages_between(self._position, self._position + count):
            self._overlay(data, number)
        self._position += count
        return bytes(data)

    def readinto(self, buffer: memoryview) -> int:
        """Fill the buffer from here; the number of bytes read."""
        data = self.read(len(buffer))
        buffer[: len(data)] = data
        return len(data)

    def write(self, data: bytes | memoryview) -> int:
        """Write here: in place into memory, behind the old end into the file."""
        data = bytes(data)
        start, stop = self._position, self._position + len(data)
        inside = min(stop, self._end)
        if start < inside:
            self._write_pages(start, data[: inside - start])
        if stop > max(start, inside):
            begin = max(start, inside)
            self._file.seek(begin)
            self._file.write(data[begin - start :])
        self._position = stop
        self._size = max(self._size, stop)
        return len(data)

    def truncate(self, size: int | None = None) -> int:
        """Set the size [bytes] that the file shall have after ``commit``."""
        self._size = self._position if size is None else size
        return self._size

    def flush(self) -> None:
        """Nothing yet: the order of writes is what keeps the file safe."""

    def commit(self) -> None:
        """Make all changes visible. Safe against a kill at any moment."""
        self._file.truncate(max(self._size, self._end))
        self._file.flush()
        os.fsync(self._file.fileno())
        pages = {n: bytes(page) for n, page in self._pages.items()}
        self._write_journal(pages)
        _apply(self._file, self._size, pages)
        journal_path(self.path).unlink()
        self._pages.clear()
        self._end = self._size

    def _write_journal(self, pages: dict[int, bytes]) -> None:
        body = bytearray(_HEAD.pack(_MAGIC, self._size, len(pages)))
        for number, page in pages.items():
            body += _PIECE.pack(number, len(page)) + page
        journal = journal_path(self.path)
        draft = journal.with_name(journal.name + ".new")
        with draft.open("wb") as file:
            file.write(body + hashlib.sha256(body).digest())
            file.flush()
            os.fsync(file.fileno())
        draft.replace(journal)

    def _pages_between(self, start: int, stop: int) -> list[int]:
        if not self._pages or stop <= start:
            return []
        wanted = range(start // _PAGE, (stop - 1) // _PAGE + 1)
        return [number for number in wanted if number in self._pages]

    def _overlay(self, data: bytearray, number: int) -> None:
        """Copy the waiting page over `data`, which begins at the position."""
        page_start, page = number * _PAGE, self._pages[number]
        begin = max(page_start, self._position)
        end = min(page_start + len(page), self._position + len(data))
        if begin < end:
            piece = page[begin - page_start : end - page_start]
            data[begin - self._position : end - self._position] = piece

    def _write_pages(self, start: int, data: bytes) -> None:
        stop = start + len(data)
        for number in range(start // _PAGE, (stop - 1) // _PAGE + 1):
            page_start = number * _PAGE
            if number not in self._pages:
                length = min(_PAGE, self._end - page_start)
                self._file.seek(page_start)
                self._pages[number] = bytearray(self._file.read(length))
            begin, end = max(page_start, start), min(page_start + _PAGE, stop)
            piece = data[begin - start : end - start]
            self._pages[number][begin - page_start : end - page_start] = piece
