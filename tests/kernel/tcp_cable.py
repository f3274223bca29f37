"""A network cable in the guest: a port that leads to a simulated instrument's, and what can go wrong between.
Faults are UsbFaults' (tools/axiscal-simulate/wire/usb/usb_faults.hpp) as far as TCP has them."""

import contextlib
import socket
import threading

FAULTS = ("none", "down", "mute", "cut", "corrupt")


class TcpCable:
    """down: connections are reset, new ones refused. mute: nothing more comes back, the connection stays. cut: of
    each piece that comes back the first `number` bytes. corrupt: each byte that comes back is XORed with `number`."""

    def __init__(self):
        self.to_port, self.fault, self.number, self.open = None, "none", 0, []
        self.lock = threading.Lock()
        with socket.create_server(("127.0.0.1", 0)) as chosen:
            self.port = chosen.getsockname()[1]
        self.door = None

    def lead_to(self, port):
        self.to_port = port
        self.plug()

    def plug(self):
        self.door = socket.create_server(("127.0.0.1", self.port))
        threading.Thread(target=self.welcome, args=(self.door,), daemon=True).start()

    def suffer(self, fault, number=0):
        assert fault in FAULTS, fault
        before, self.fault, self.number = self.fault, fault, number
        if fault == "down":
            self.door.shutdown(socket.SHUT_RDWR)  # wakes the thread that accepts
            self.door.close()
            self.hang_up()
        elif before == "down":
            self.plug()

    def hang_up(self):
        with self.lock:
            ends, self.open = self.open, []
        for end in ends:
            with contextlib.suppress(OSError):
                end.shutdown(socket.SHUT_RDWR)

    def welcome(self, door):
        with contextlib.suppress(OSError):  # the door was closed
            while True:
                station, _ = door.accept()
                device = socket.create_connection(("127.0.0.1", self.to_port))
                with self.lock:
                    self.open += [station, device]
                for ends in ((station, device, False), (device, station, True)):
                    threading.Thread(target=self.carry, args=ends, daemon=True).start()

    def carry(self, source, target, spoils):
        with contextlib.suppress(OSError):
            while piece := source.recv(65536):
                target.sendall(self.spoilt(piece) if spoils else piece)
        for end in (source, target):
            with contextlib.suppress(OSError):
                end.shutdown(socket.SHUT_RDWR)

    def spoilt(self, piece):
        if self.fault == "mute":
            return b""
        if self.fault == "cut":
            return piece[: self.number]
        if self.fault == "corrupt":
            return bytes(byte ^ self.number for byte in piece)
        return piece
