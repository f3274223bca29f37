"""A real axiscald with a socket, a port and a state of its own, for tests of what it answers."""

import os
import re
import subprocess
import time

from axiscal_cli import BIN, Scratch, example_text, run
from daemons import free_port


class OneDaemon(Scratch):
    def setUp(self):
        super().setUp()
        self.socket, self.port = os.path.join(self.folder, "d.sock"), free_port()
        self.state = os.path.join(self.folder, "state")
        self.daemon = None
        self.addCleanup(self.end)

    def station_file(self, port=None, more=""):
        """The example with that socket and port; `more` are lines of [console]."""
        text = example_text().replace('# state_directory = "/var/lib/axiscal"', f'state_directory = "{self.state}"')
        console = f'[console]\nsocket = "{self.socket}"\ngroup = ""\nport = {self.port if port is None else port}\n{more}'
        return self.file("station.toml", re.sub(r"^port = 1502$", f"port = {free_port()}", text.replace("[console]\n", console), flags=re.M))

    def begin_with(self, station_file):
        with open(os.path.join(self.folder, "log"), "a", encoding="utf-8") as log:
            self.daemon = subprocess.Popen([os.path.join(BIN, "axiscald"), "--config", station_file], stderr=log, stdout=log)
        while run("status", "--socket", self.socket).returncode != 0:  # ctest's limit ends it
            self.assertIsNone(self.daemon.poll(), f"axiscald ended: {self.log()}")
            time.sleep(0.02)

    def end(self):
        if self.daemon and self.daemon.poll() is None:
            self.daemon.terminate()
            self.assertEqual(self.daemon.wait(20), 0)

    def log(self):
        with open(os.path.join(self.folder, "log"), encoding="utf-8") as log:
            return log.read()

    def until_logged(self, words):
        while words not in self.log():  # the log has a thread of its own; ctest's limit ends it
            time.sleep(0.02)
