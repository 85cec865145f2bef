#!/usr/bin/env python3
"""What the bridge of a plucked string hears, and the partials that it should have, in spectrum.svg.

    bash examples/run.sh 10_pluck_a_string && python3 docs/images/spectrum.py string.wav docs/images/spectrum.svg
"""
import cmath
import math
import struct
import sys
import wave

with wave.open(sys.argv[1]) as file:
    rate, count = file.getframerate(), 1 << 15
    x = struct.unpack(f"<{count}h", file.readframes(count))


def transform(x):
    if len(x) == 1:
        return x
    even, odd, n = transform(x[::2]), transform(x[1::2]), len(x)
    turned = [cmath.exp(-2j * math.pi * k / n) * odd[k] for k in range(n // 2)]
    return [a + b for a, b in zip(even, turned)] + [a - b for a, b in zip(even, turned)]


size = [abs(c) for c in transform([v * (1 - math.cos(2 * math.pi * (k + 0.5) / count)) for k, v in enumerate(x)])]

# 80 N in 650 mm of steel, 0.8 mm: f = n f1 √(1 + B n²), as it is stretched.
area, young, tension = math.pi * 0.0008**2 / 4, 200e9, 80
stretch = 1 + tension / (young * area)
length, mass = 0.65 * stretch, 7850 * area / stretch
first = math.sqrt(tension / mass) / (2 * length)
stiff = math.pi**2 * young * area * 0.0008**2 / 16 / (tension * length**2)
partials = [n * first * math.sqrt(1 + stiff * n * n) for n in range(1, 11)]

left, right, top, bottom, most, least = 52, 780, 14, 250, 1200, -80
X = lambda f: left + f / most * (right - left)
loudest = max(size)
Y = lambda s: top + 20 * math.log10(max(s / loudest, 10 ** (least / 20))) / least * (bottom - top)
curve = " ".join(f"{X(k * rate / count):.1f},{Y(s):.1f}" for k, s in enumerate(size) if k * rate / count <= most)
out = ['<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 800 290" font-family="sans-serif" font-size="13">',
       '<rect width="800" height="290" fill="#fcfcfa"/>']
for f in partials:
    out.append(f'<line x1="{X(f):.1f}" x2="{X(f):.1f}" y1="{top}" y2="{bottom}" stroke="#e69f00" stroke-width="4" opacity="0.45"/>')
out.append(f'<polyline points="{curve}" fill="none" stroke="#0072b2" stroke-width="1.4"/>')
for f in range(0, most, 200):
    out.append(f'<text x="{X(f):.0f}" y="{bottom + 18}" text-anchor="middle" fill="#5f6773">{f}{" Hz" if f == 1000 else ""}</text>')
for level in range(0, least - 1, -20):
    out.append(f'<text x="{left - 6}" y="{Y(loudest * 10 ** (level / 20)) + 4:.0f}" text-anchor="end" fill="#5f6773">{level}{" dB" if level == 0 else ""}</text>')
out.append(f'<text x="{left}" y="284" fill="#282c34">blue: the sound of 10_pluck_a_string; yellow: partials of a stiff string, exactly</text></svg>')
with open(sys.argv[2], "w", encoding="utf-8") as file:
    file.write("\n".join(out) + "\n")
