"""A disk that is full, for this process: a limit of the size of files, which root obeys as well."""

import resource
import sys
from contextlib import contextmanager
from functools import wraps


@contextmanager
def largest_file(size):
    """Let every write beyond `size` bytes of a file fail, as on a disk without room."""
    soft, hard = resource.getrlimit(resource.RLIMIT_FSIZE)
    keeps = sys.dont_write_bytecode
    sys.dont_write_bytecode = True  # of modules that are imported meanwhile: Python leaves them cut short
    resource.setrlimit(resource.RLIMIT_FSIZE, (size, hard))
    try:
        yield
    finally:
        sys.dont_write_bytecode = keeps
        resource.setrlimit(resource.RLIMIT_FSIZE, (soft, hard))


def under_limit(size, function):
    """The function, carried out with such a limit."""

    @wraps(function)
    def limited(*arguments, **options):
        with largest_file(size):
            return function(*arguments, **options)

    return limited
