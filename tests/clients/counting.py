"""A relay in front of the service that counts what comes back: counting.py HOST PORT. It writes the port on which it listens;
once its input is closed, it writes what was asked for and how many bytes came back, as JSON, and ends.

A process of its own: GDAL holds the lock of Python's threads while it reads."""

import contextlib
import json
import socket
import sys
import threading

SERVICE = (sys.argv[1], int(sys.argv[2]))
sizes, requests = [], []


def pass_on(source, target, is_answer):
    """Everything that one side sends, until it hangs up."""
    while data := source.recv(65_536):
        if is_answer:
            sizes.append(len(data))
        elif data.startswith(b"GET "):
            requests.append(data.split(b" ", 2)[1].decode())
        target.sendall(data)
    with contextlib.suppress(OSError):
        target.shutdown(socket.SHUT_WR)


def accept(listener):
    """A connection to the service for each that arrives."""
    while True:
        client, _ = listener.accept()
        service = socket.create_connection(SERVICE)
        for ends in ((client, service, False), (service, client, True)):
            threading.Thread(target=pass_on, args=ends, daemon=True).start()


listener = socket.create_server(("127.0.0.1", 0))
threading.Thread(target=accept, args=(listener,), daemon=True).start()
print(listener.getsockname()[1], flush=True)
sys.stdin.read()
print(json.dumps({"bytes": sum(sizes), "requests": requests}))
