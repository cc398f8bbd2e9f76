"""A turntable's board behind a pseudo-terminal (the text protocol of docs/reference/motor.md)."""

import os
import pty
import select
import threading
import time
import tty


def sealed(text):
    total = 0
    for byte in text.encode():
        total ^= byte
    return f"{text} *{total:02x}"


class Table:
    """Runs until close(). fault: None, 'silent' (from the first turn on) or 'gone'."""

    def __init__(self, fault=None):
        self.fault, self.faulty = fault, False
        self.master, self.slave = pty.openpty()
        tty.setraw(self.slave)
        self.port = os.ttyname(self.slave)
        self.angle, self.speed, self.target = 0.0, 0.0, None
        self.halted, self.told = False, False
        self.moved = self.heard = time.monotonic()
        self.open = True
        self.thread = threading.Thread(target=self.run, daemon=True)
        self.thread.start()

    def close(self):
        self.open = False
        self.thread.join()
        for fd in (self.master, self.slave):
            try:
                os.close(fd)
            except OSError:
                pass

    def turning(self):
        self.advance()
        return self.speed != 0.0

    def advance(self):
        now = time.monotonic()
        if now - self.heard > 2.0:
            self.speed = 0.0
        self.angle += self.speed * (now - self.moved)
        self.moved = now
        if self.target is not None and (self.target - self.angle) * self.speed <= 0 and self.speed:
            self.angle, self.speed = self.target, 0.0

    def answer(self, number, text):
        if not (self.faulty and self.fault == "silent"):
            os.write(self.master, (sealed(f"{number} {text}") + "\n").encode())

    def obey(self, line):
        if " *" not in line or sealed(line[:line.rindex(" *")]) != line:
            return
        self.heard = time.monotonic()
        number, command, *values = line[:line.rindex(" *")].split()
        if command == "hello":
            return self.answer(number, "ok turnscan-table 1 test")
        if command == "stop":
            self.speed, self.halted = 0.0, False
            return self.answer(number, "ok")
        if command == "status":
            state = "halted" if self.halted else "turning" if self.speed else "idle"
            return self.answer(number, f"ok {state} {self.angle:.4f}")
        angle = float(values[0])
        speed = abs(float(values[-1]))
        self.target = self.angle + angle if command == "move" else None
        self.speed = speed if angle > 0 else -speed
        self.told = True
        self.answer(number, "ok")
        self.faulty = True
        if self.fault == "gone":
            os.close(self.slave)
            os.close(self.master)
            self.open = False

    def run(self):
        line = ""
        while self.open:
            ready, _, _ = select.select([self.master], [], [], 0.01)
            self.advance()
            if not ready:
                continue
            try:
                text = os.read(self.master, 200).decode("latin-1")
            except OSError:
                continue
            for c in text:
                if c == "!":
                    self.speed, self.halted = 0.0, True
                elif c == "\n":
                    self.obey(line)
                    line = ""
                else:
                    line += c
