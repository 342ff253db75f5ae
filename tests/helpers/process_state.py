"""What belongs to the whole process, or to a thread, and must be as it was after each call."""

import contextvars
import decimal
import faulthandler
import gc
import locale
import logging
import multiprocessing
import os
import random
import resource
import signal
import socket
import sys
import threading
import tracemalloc
import warnings

import gmpy2
import numpy as np

SIGNALS = sorted(signal.valid_signals() - {signal.SIGKILL, signal.SIGSTOP})
LIMITS = [name for name in dir(resource) if name.startswith("RLIMIT_")]


def state_of_thread():
    """Return the state of this thread by name, as values that compare equal if nothing changed."""
    decimals = decimal.getcontext()
    return {
        "decimal context": repr(decimals),  # its flags are part of it
        "gmpy2 context": repr(gmpy2.get_context()),
        "errors of numpy": (np.geterr(), np.geterrcall()),
        "context variables": {
            variable.name: repr(value) for variable, value in contextvars.copy_context().items()
        },
        "trace function": sys.gettrace(),
        "signal mask": sorted(signal.pthread_sigmask(signal.SIG_BLOCK, [])),
    }


def state_of_process():
    """Return the state of the process by name, as `state_of_thread` does of the thread."""
    umask = os.umask(0)
    os.umask(umask)
    return {
        "limit on digits": sys.get_int_max_str_digits(),
        "recursion limit": sys.getrecursionlimit(),
        "switch interval": sys.getswitchinterval(),
        "paths of modules": list(sys.path),
        "finders": (list(sys.meta_path), list(sys.path_hooks)),
        "arguments": list(sys.argv),
        "streams": (sys.stdin, sys.stdout, sys.stderr),
        "hooks": (sys.excepthook, sys.unraisablehook, sys.displayhook, threading.excepthook),
        "built-in names": sorted(vars(__import__("builtins"))),
        "signal handlers": [signal.getsignal(number) for number in SIGNALS],
        "timer": signal.getitimer(signal.ITIMER_REAL)[1],
        "locale": locale.setlocale(locale.LC_ALL),
        "printing of numpy": repr(np.get_printoptions()),
        "random numbers": random.getstate(),
        "random numbers of numpy": repr(np.random.get_state()),
        "warnings": (list(warnings.filters), warnings.showwarning),
        "environment": dict(os.environ),
        "folder": os.getcwd(),
        "umask": umask,
        "limits": [resource.getrlimit(getattr(resource, name)) for name in LIMITS],
        "collector": (gc.isenabled(), gc.get_threshold(), gc.get_freeze_count(), gc.callbacks[:]),
        "threads": threading.active_count(),
        "start method": multiprocessing.get_start_method(allow_none=True),
        "children": multiprocessing.active_children(),
        "open files": sorted(os.listdir("/proc/self/fd")),
        "logging": (logging.root.level, list(logging.root.handlers)),
        "fault handler": faulthandler.is_enabled(),
        "tracing of memory": tracemalloc.is_tracing(),
        "timeout of sockets": socket.getdefaulttimeout(),
        **state_of_thread(),
    }


def changed(before, after):
    """Return the entries that differ, with both values."""
    return {name: (before[name], after[name]) for name in before if before[name] != after[name]}
