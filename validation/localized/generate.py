"""Makes one-level.csv: what a circle around an indenter of a triangular lattice holds.   python generate.py > one-level.csv"""

from math import pi, sqrt

HEAD = """\
# Circles around an indenter of a triangular lattice of period 1: neighbours inside, radius R with pi R^2 / A0 = neighbours + 1,
# S3 = sum 1/r^3 + 2/(R0^2 R), S1 = sum 1/r - 2R/R0^2. Sums in high precision, independent of this program, printed with four
# decimals. The whole lattice has S3 = 11.0342, S1 = -4.2134.
neighbours,radius,s3,s1"""
SIZE = 6
squares = sorted(i * i + i * j + j * j for i in range(-SIZE, SIZE + 1) for j in range(-SIZE, SIZE + 1))[1:]
first = sqrt(sqrt(3) / 2 / pi)  # R0

print(HEAD)
for neighbours in (0, 6, 12, 18, 30, 36, 54):
    radius = first * sqrt(neighbours + 1)
    inside = [sqrt(value) for value in squares[:neighbours]]
    third = sum(r**-3 for r in inside) + 2 / (first**2 * radius)
    print(f"{neighbours},{radius:.4f},{third:.4f},{sum(1 / r for r in inside) - 2 * radius / first**2:.4f}")
