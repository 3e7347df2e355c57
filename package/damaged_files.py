# SPDX-License-Identifier: GPL-3.0-or-later
"""What is wrong with a damaged file, in a sentence: said by the readers here, and of what those of others raise."""

from __future__ import annotations

import errno
from collections.abc import Iterator
from contextlib import contextmanager

from .core.errors import ReebError
from .core.memory import lacks_memory
from .core.sentence import Sentence


class DamagedFileError(ReebError, ValueError):
    """A file is damaged; the message says how, as a sentence goes on behind the name of the file and a colon."""


@contextmanager
def read_by(library: str, *passed: type[Exception]) -> Iterator[None]:
    """Raise DamagedFileError in place of whatever a library raises at a damaged file.

    Only calls of that library belong inside: what our own code raises there would be taken for a damage, too.

    Parameters
    ----------
    library : str
        Its name, for the sentence.
    passed : types of Exception
        What the caller wants to know.

    Raises
    ------
    DamagedFileError
        In place of other exceptions, whose words it has.
    MemoryError
        There is not enough memory.
    ImportError
        A package is not there.
    OSError
        The system could not read a file.
    """
    try:
        yield
    except Exception as error:  # whatever a reader of damaged files raises
        if isinstance(error, (MemoryError, ImportError, ReebError, *passed)):
            raise
        # A place before the begin of the file, which only a damaged file asks for, is an invalid argument.
        if isinstance(error, OSError) and error.errno not in (None, errno.EINVAL):
            raise
        if lacks_memory(str(error)):
            raise MemoryError from error
        if isinstance(error, FileNotFoundError):
            raise DamagedFileError(Sentence("{name}, which it refers to, is not there", name=error)) from error
        kind, said = type(error).__name__, str(error)
        words = said if said.startswith(kind) else f"{kind}: {said}" if said else kind
        raise DamagedFileError(Sentence("it is damaged, or has what {library} does not read ({words})",
                                        library=library, words=words)) from error
