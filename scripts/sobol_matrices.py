#!/usr/bin/python3
# SPDX-License-Identifier: MIT
"""Writes data/sobol_4d.txt: the generating matrices of the first four coordinates of Sobol'.

From the first lines of new-joe-kuo-6.21201 (S. Joe, F. Y. Kuo, SIAM J. Sci. Comput. 30 (2008)
2635-2654, doi:10.1137/070709359). Each column is an integer of 32 bits; its highest bit is the
first digit after the radix point.
"""

from pathlib import Path

DIGITS = 32

# Degree s of the primitive polynomial, its inner coefficients a, and m_1, ..., m_s.
PARAMETERS = [(1, 0, [1]), (2, 1, [1, 3]), (3, 1, [1, 3, 1])]


def columns_of(degree, inner, starts):
    """Sobol's recurrence m_i = 2 a_1 m_(i-1) ^ ... ^ 2^s m_(i-s) ^ m_(i-s), as columns."""
    m = list(starts)
    while len(m) < DIGITS:
        new = m[-degree] ^ (m[-degree] << degree)
        for k in range(1, degree):
            new ^= ((inner >> (degree - 1 - k)) & 1) * (m[-k] << k)
        m.append(new)
    return [number << (DIGITS - 1 - j) for j, number in enumerate(m)]


def main():
    matrices = [[1 << (DIGITS - 1 - j) for j in range(DIGITS)]]
    matrices += [columns_of(*parameters) for parameters in PARAMETERS]
    lines = [
        "# dnet",
        "# Sobol' sequence, first four coordinates; Joe and Kuo 2008, doi:10.1137/070709359;",
        "# rebuilt by scripts/sobol_matrices.py",
        "2   # base",
        f"{len(matrices)}   # matrices",
        f"{DIGITS}  # columns: 2^{DIGITS} points",
        f"{DIGITS}  # rows",
    ]
    lines += [" ".join(map(str, columns)) for columns in matrices]
    target = Path(__file__).resolve().parent.parent / "data/sobol_4d.txt"
    target.write_text("\n".join(lines) + "\n")


if __name__ == "__main__":
    main()
