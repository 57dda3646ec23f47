"""A simulated participant who only sees the screen's pixels and uses a mouse.

Recognizes buttons (src/window/Painter.cpp) and the scene's objects by their colors.
"""
import mmap
import struct
import time
from collections import namedtuple
from pathlib import Path

KINDS = {(49, 56, 65): "plain", (94, 177, 255): "primary", (29, 33, 38): "disabled"}
SMALLEST = 0.08  # a button's sides, of the unit of lengths
BACKGROUND = (20, 23, 27)  # beside buttons; flags in the scene have colors of buttons, too

Button = namedtuple("Button", "kind x y width height")


def middle(area):
    return int(area.x + area.width / 2), int(area.y + area.height / 2)


class Eyes:
    """Reads the memory in which Xvfb keeps its picture (-fbdir)."""

    def __init__(self, folder, size):
        self.width, self.height = size
        self.unit = min(self.height, 0.6 * self.width)
        self.step = max(1, round(self.unit / 150))
        with (Path(folder) / "Xvfb_screen0").open("rb") as file:
            self.memory = mmap.mmap(file.fileno(), 0, access=mmap.ACCESS_READ)
        header = struct.unpack(">25I", self.memory[:100])  # XWDFileHeader
        self.row_bytes, self.start = header[12], header[0] + 12 * header[19]

    def pixel(self, x, y):
        begin = self.start + y * self.row_bytes + 4 * x
        return tuple(self.memory[begin + i] for i in (2, 1, 0))

    def rows(self):
        """Of every few pixels, (red, green, blue)."""
        for y in range(0, self.height, self.step):
            begin = self.start + y * self.row_bytes
            row = self.memory[begin:begin + 4 * self.width]
            yield list(zip(row[2::4 * self.step], row[1::4 * self.step], row[::4 * self.step]))

    def areas(self, kind_of):
        """Connected pixels of a kind, as (kind, left, top, right, bottom, number), in steps."""
        kinds = [[kind_of(pixel) for pixel in row] for row in self.rows()]
        found = []
        for y, row in enumerate(kinds):
            for x, kind in enumerate(row):
                if kind is None:
                    continue
                stack, at = [(x, y)], []
                kinds[y][x] = None
                while stack:
                    px, py = stack.pop()
                    at.append((px, py))
                    for nx, ny in ((px - 1, py), (px + 1, py), (px, py - 1), (px, py + 1)):
                        if 0 <= ny < len(kinds) and 0 <= nx < len(row) and kinds[ny][nx] == kind:
                            kinds[ny][nx] = None
                            stack.append((nx, ny))
                xs, ys = [x for x, _ in at], [y for _, y in at]
                found.append((kind, min(xs), min(ys), max(xs) + 1, max(ys) + 1, len(at)))
        return found

    def boxes(self, kind_of, least):
        for kind, left, top, right, bottom, n in self.areas(kind_of):
            box = Button(kind, *(self.step * v for v in (left, top, right - left, bottom - top)))
            if min(box.width, box.height) >= least and n >= 0.5 * (right - left) * (bottom - top):
                yield box

    def buttons(self):
        """From the top, then from the left."""
        found = [b for b in self.boxes(KINDS.get, SMALLEST * self.unit)
                 if self.pixel(b.x - int(0.012 * self.unit), middle(b)[1]) == BACKGROUND]
        return sorted(found, key=lambda b: (round(b.y / (0.05 * self.unit)), b.x))

    def objects(self):
        """The effector's box and the cubes, from the left."""
        def kind_of(pixel):
            red, green, blue = pixel
            if pixel in KINDS:
                return None
            if red > 150 and red - blue > 110:
                return "cube"
            return "effector" if blue > 120 and blue - red > 70 else None
        found = sorted(self.boxes(kind_of, 0.03 * self.unit), key=lambda b: b.x)
        return ([b for b in found if b.kind == "effector"], [b for b in found if b.kind == "cube"])


class Participant:
    """Knows what to answer, and clicks buttons that look as if they could be clicked."""

    def __init__(self, screen, eyes, is_over):
        self.screen, self.eyes, self.is_over = screen, eyes, is_over

    def see(self, what, seconds=90):
        """Waits until what(buttons) is something."""
        deadline = time.time() + seconds
        while time.time() < deadline and not self.is_over():
            seen = what(self.eyes.buttons())
            if seen:
                return seen
            time.sleep(0.1)
        raise AssertionError(f"not seen: {what.__doc__}, but {self.eyes.buttons()}")

    def click(self, area):
        self.screen.do("mousemove", *middle(area), "click", 1)

    def read_on(self):
        """Through the pages of texts, to a trial."""
        def trial_or_next(buttons):
            """a trial, or a button that continues"""
            answers = [b for b in buttons if b.kind == "plain"]
            if len(buttons) > 2 and len(answers) > 2:
                return "trial"
            return next((b for b in buttons if b.kind == "primary" and len(buttons) < 3), None)
        while (seen := self.see(trial_or_next)) != "trial":
            self.click(seen)
            time.sleep(0.3)

    def push(self, n):
        """The cube number n, four times, with the dragged box, and back. On a busy machine pictures
        come so late that the box jumps, and a jump pushes nothing."""
        effectors, cubes = self.eyes.objects()
        x, y = middle(effectors[0])
        to_x, to_y = middle(cubes[n])
        stroke = [["mousemove", to_x, to_y], ["mousemove", to_x, y]] * 4
        for move in (["mousemove", x, y, "mousedown", 1], ["mousemove", to_x, y], *stroke,
                     ["mousemove", x, y], ["mouseup", 1]):
            self.screen.do(*move)
            time.sleep(0.5)

    def sort(self, order):
        """Gives cube i the label order[i], and confirms."""
        def cubes_and_labels(buttons):
            """three cubes and three labels"""
            return buttons[:6] if len(buttons) == 9 and buttons[0].kind == "plain" else None
        cells = self.see(cubes_and_labels)
        for cube, label in enumerate(order):
            def selected(buttons):
                """the labels of the selected cube"""
                return any(b.kind == "plain" and abs(b.y - cells[3 + label].y) < 0.05 * self.eyes.unit
                           for b in buttons)
            self.click(cells[cube])
            self.see(selected)
            time.sleep(0.3)  # a second tap on a button in the same moment does not count
            self.click(cells[3 + label])
            time.sleep(0.3)
        def confirm(buttons):
            """the button that confirms"""
            return next((b for b in buttons if b.kind == "primary"), None)
        self.click(self.see(confirm))
        def another_page(buttons):
            """a page after the trial"""
            return 0 < len(buttons) < 6
        self.see(another_page)

    def choose(self, n):
        """The answer number n of a comparison."""
        def answers(buttons):
            """left, right and no difference"""
            return buttons if len(buttons) == 4 and {b.kind for b in buttons} == {"plain"} else None
        self.see(answers)
        time.sleep(0.8)  # the first moments of a trial take no answers
        self.click(self.see(answers)[n])
        def others(buttons):
            """that the answer was taken"""
            kinds = {b.kind for b in buttons}
            return "primary" in kinds or (len(buttons) > 2 and kinds == {"disabled"})
        self.see(others)

    def finish(self, seconds=90):
        """Through the last pages, until the program ends."""
        deadline = time.time() + seconds
        while not self.is_over() and time.time() < deadline:
            for button in self.eyes.buttons():
                if button.kind == "primary":
                    self.click(button)
            time.sleep(0.5)
