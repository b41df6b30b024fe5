"""Ports for servers that are started later."""
import contextlib
import socket


@contextlib.contextmanager
def held_port():
    """A TCP port that nobody else gets while it is held, neither a server without a number nor a client: it is bound.

    A server that sets SO_REUSEADDR, as masters of ROS, schedulers of Dask and PostgreSQL do, listens on it all the same.
    """
    with socket.socket() as holder:
        holder.setsockopt(socket.SOL_SOCKET, socket.SO_REUSEADDR, 1)
        holder.bind(("", 0))
        yield holder.getsockname()[1]
