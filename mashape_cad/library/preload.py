"""Loads what a worker needs, once, in the process that workers are forked from (see `mashape_cad.scanning`).

Importing this module is all there is to it: a worker forked afterwards is ready at once and shares the memory. Where
the kernel is missing, nothing is loaded, and the first file says so.
"""

import signal
from contextlib import suppress

from mashape_cad.errors import KernelUnavailableError

# Loading takes seconds, and Ctrl-C meanwhile is meant for this process too: it ends without a word.
signal.signal(signal.SIGINT, signal.SIG_DFL)
with suppress(KernelUnavailableError):
    import mashape_cad.reading.dxf
    import mashape_cad.reading.step  # noqa: F401
    from mashape_cad.library.derivation import warm_up

    # Compiled once here, the first time after an installation for a minute, instead of in every worker. What goes wrong
    # goes wrong again in the worker, which can say so.
    with suppress(Exception):
        warm_up()
