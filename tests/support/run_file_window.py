"""The samples of a point as docs/run-file.md tells their bytes.

A sample is (time in ns, reading in metres, the instrument's own sample number). Nothing of the product is used.
"""
import struct

WORDS = 1 << 64


def bits_of(number):
    return struct.unpack("<Q", struct.pack("<d", number))[0]


def folded(difference):
    """Of a difference modulo 2^64, taken as one with a sign."""
    difference = (difference + WORDS // 2) % WORDS - WORDS // 2
    return 2 * difference if difference >= 0 else -2 * difference - 1


def unfolded(word):
    return word // 2 if word % 2 == 0 else -(word + 1) // 2


def steps(numbers):
    return [b - a for a, b in zip([0] + numbers, numbers)]


def sums(differences):
    numbers, last = [], 0
    for difference in differences:
        last = (last + difference) % WORDS
        numbers.append(last)
    return numbers


def leb128(number):
    out = bytearray()
    while number > 0x7F:
        out.append(number & 0x7F | 0x80)
        number >>= 7
    return bytes(out) + bytes([number])


def packed(samples):
    columns = (steps(steps([at_ns for at_ns, _, _ in samples])), steps([bits_of(reading) for _, reading, _ in samples]),
               steps(steps([number for _, _, number in samples])))
    return leb128(len(samples)) + b"".join(leb128(folded(d)) for column in columns for d in column)


def numbers_in(data):
    number, shift = 0, 0
    for byte in data:
        number |= (byte & 0x7F) << shift
        shift += 7
        if byte < 0x80:
            yield number
            number, shift = 0, 0


def unpacked(data):
    count, *words = numbers_in(data)
    if len(words) != 3 * count:
        raise ValueError(f"{count} samples are told by {len(words)} numbers")
    differences = [unfolded(word) for word in words]
    times, readings, numbers = (differences[i * count:(i + 1) * count] for i in range(3))
    signed = [(at_ns + WORDS // 2) % WORDS - WORDS // 2 for at_ns in sums(sums(times))]
    readings = [struct.unpack("<d", struct.pack("<Q", bits))[0] for bits in sums(readings)]
    return list(zip(signed, readings, sums(sums(numbers))))
