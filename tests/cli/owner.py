#!/usr/bin/env python3
"""Root does not start the daemon on the folder of the service's user.   owner.py BIN_FOLDER SOURCE_FOLDER

Needs root, or a user whom sudo obeys. Exit 77 (skipped) only where neither is and AXISCAL_MAY_SKIP names systemd.
"""
import os
import pwd
import sys
import unittest
from pathlib import Path

sys.path.append(str(Path(__file__).resolve().parents[1] / "support"))
import as_root


class Owner(unittest.TestCase):
    def test_root_is_sent_to_the_owner_of_the_folder_and_leaves_nothing(self):
        nobody = pwd.getpwnam("nobody")
        test = daemons.Neighbours("station")
        test.setUp()
        try:
            config, state = test.station("first"), os.path.join(test.folder, "first")
            os.mkdir(state)
            os.chown(state, nobody.pw_uid, nobody.pw_gid)
            daemon = test.begin(config)
            self.assertEqual(daemon.wait(20), 1)
            told = daemon.stderr.read()
            for words in (state, "nobody", "sudo -u nobody"):
                self.assertIn(words, told)
            self.assertEqual(os.listdir(state), [])
            outbox, share = os.path.join(state, "outbox"), os.path.join(test.folder, "share")
            for folder in (outbox, share):
                os.mkdir(folder)
            os.chown(outbox, nobody.pw_uid, nobody.pw_gid)
            publisher = daemons.program("axiscal-publish", "--outbox", outbox, "--to", share, "--once")
            self.assertEqual(publisher.returncode, 3)
            self.assertIn("sudo -u nobody axiscal-publish", publisher.stderr)
            self.assertEqual(os.listdir(outbox), [])
            os.rmdir(outbox)
            os.chown(state, 0, 0)
            daemon = test.begin(config)
            test.until_it_answers(daemon)
            test.end(daemon)
            token = os.path.join(state, "token")
            os.chown(token, nobody.pw_uid, nobody.pw_gid)
            daemon = test.begin(config)
            self.assertEqual(daemon.wait(20), 1)
            told = daemon.stderr.read()
            self.assertIn(f"{token} belongs to user {nobody.pw_uid}", told)
            self.assertIn(f"remove {token}", told)
        finally:
            test.doCleanups()


if __name__ == "__main__":
    try:
        as_root.require()
    except as_root.NoRoot as why:
        print(f"skipped: {why}")
        sys.exit(77 if "systemd" in os.environ.get("AXISCAL_MAY_SKIP", "").split(",") else 1)
    import daemons
    unittest.main(argv=sys.argv[:1], verbosity=2)
