"""Binary dumps of LAMMPS and of LIGGGHTS: per step a header and the doubles of the floes that touch, mostly none."""
import struct

import numpy as np


def first_header(data):
    """Where the step stands in every header, how long the header is, and the number of columns."""
    at = 0
    step, = struct.unpack_from("<q", data, at)
    newer = step < 0  # minus the length of a magic word; then the word, the byte order and a revision
    if newer:
        at += 8 - step + 8
    at_step = at
    triclinic, = struct.unpack_from("<i", data, at + 16)
    at += 20 + 6 * 4 + 6 * 8 + (24 if triclinic else 0)
    width, = struct.unpack_from("<i", data, at)
    at += 4
    if newer:
        at += 4 + struct.unpack_from("<i", data, at)[0]  # the units
        at += 1 + (8 if data[at] else 0)  # the time
        at += 4 + struct.unpack_from("<i", data, at)[0]  # the columns
    if struct.unpack_from("<i", data, at)[0] != 1:
        raise RuntimeError("a dump written by more than one process")
    return at_step, at + 8, width


def read(path, columns):
    """Steps and rows of a dump with so many columns."""
    with open(path, "rb") as file:
        data = file.read()
    at_step, length, width = first_header(data)
    if width != columns:
        raise RuntimeError(f"{path}: {width} columns, wanted {columns}")
    get = struct.Struct("<qq").unpack_from
    steps, starts, counts = [], [], []
    at, end = 0, len(data)
    while at < end:
        step, count = get(data, at + at_step)
        at += length
        if count:
            steps.append(step)
            starts.append(at)
            counts.append(count)
            at += 8 * width * count
    rows = [np.frombuffer(data, "<f8", width * n, s).reshape(n, width) for s, n in zip(starts, counts)]
    return np.repeat(np.array(steps, int), counts), np.concatenate(rows or [np.zeros((0, width))])
