"""A receiver of the webhook, in Python's own server: what it does to each POST is scripted, and what it takes it
checks by code of its own, which is the code of docs/webhook.md."""

import base64
import hashlib
import hmac
import http.server
import json
import ssl
import threading
import time

OLDEST_S = 300


def take(headers, body, secret, seen, now):
    """The event, or None: the signature is another's, the time is old, or it was seen before."""
    name, stamp = headers["webhook-id"], headers["webhook-timestamp"]
    key = base64.b64decode(secret.removeprefix("whsec_"))
    sum_ = hmac.new(key, f"{name}.{stamp}.".encode() + body, hashlib.sha256).digest()
    wanted = "v1," + base64.b64encode(sum_).decode()
    if not any(hmac.compare_digest(wanted, one) for one in headers["webhook-signature"].split(" ")):
        return None
    if abs(now - int(stamp)) > OLDEST_S or name in seen:
        return None
    seen.add(name)
    return json.loads(body)


class Receiver:
    """`script`: one word for each POST, then "204": a status; "hang" (takes it and never answers), "reset", "garbage",
    "endless" (200 and a body without end), "half" (200 and a body that breaks off), "away PATH" (a redirect)."""

    def __init__(self, secret, script=(), certificate=None):
        self.secret, self.script = secret, list(script)
        self.posts, self.events, self.seen, self.forged = [], [], set(), 0
        self.ended = threading.Event()
        receiver = self

        class Handler(http.server.BaseHTTPRequestHandler):
            def do_POST(self):
                body = self.rfile.read(int(self.headers["Content-Length"]))
                receiver.answer(self, body)

            def log_message(self, *_):
                pass

        self.server = http.server.ThreadingHTTPServer(("127.0.0.1", 0), Handler)
        self.server.daemon_threads = True
        if certificate:
            context = ssl.SSLContext(ssl.PROTOCOL_TLS_SERVER)
            context.load_cert_chain(*certificate)
            self.server.socket = context.wrap_socket(self.server.socket, server_side=True)
        self.server.handle_error = lambda *_: None  # a client that is killed, or that trusts nobody
        self.port = self.server.server_address[1]
        threading.Thread(target=self.server.serve_forever, daemon=True).start()

    def __enter__(self):
        return self

    def __exit__(self, *_):
        self.ended.set()
        self.server.shutdown()
        self.server.server_close()

    def keep(self, handler, body):
        before = len(self.seen)
        event = take(handler.headers, body, self.secret, self.seen, time.time())
        if event is not None:
            self.events.append(event)
        elif len(self.seen) == before and handler.headers["webhook-id"] not in self.seen:
            self.forged += 1

    def answer(self, handler, body):
        word = self.script.pop(0) if self.script else "204"
        if word in ("204", "hang", "endless"):
            self.keep(handler, body)
        self.posts.append({"path": handler.path, "body": body, "headers": dict(handler.headers), "answer": word})
        handler.close_connection = True
        if word == "hang":
            self.ended.wait(150)
        elif word == "garbage":
            handler.wfile.write(b"\x00\xff no answer of the web\r\n\r\n")
        elif word == "endless":
            handler.wfile.write(b"HTTP/1.1 200 OK\r\n\r\n")
            while not self.ended.is_set():
                handler.wfile.write(b"x" * 65536)  # until the client is gone
        elif word == "half":
            handler.wfile.write(b"HTTP/1.1 200 OK\r\nContent-Length: 1000\r\n\r\nbut")
        elif word.startswith("away "):
            handler.send_response(307)
            handler.send_header("Location", word[5:])
            handler.end_headers()
        elif word != "reset":
            handler.send_response(int(word))
            handler.end_headers()
