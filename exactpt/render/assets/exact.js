// Exact numbers: integers times powers of two. They are rounded to doubles only at the end.

/** n * 2^bits, rounded down. */
function shifted(n, bits) {
  return bits >= 0 ? n << BigInt(bits) : n >> BigInt(-bits);
}

/** x * 2^k for any k. */
function scaled(x, k) {
  if (x === 0 || !Number.isFinite(x)) return x;
  for (; k > 1000; k -= 1000) x *= 2 ** 1000;
  for (; k < -1000 && x !== 0; k += 1000) x *= 2 ** -1000;
  return x * 2 ** k;
}

/** [m, e] with n = m * 2^e (m rounded to a double). */
function parts(n) {
  let e = 0;
  let m = Number(n);
  while (!Number.isFinite(m)) {
    n >>= 512n;
    e += 512;
    m = Number(n);
  }
  return [m, e];
}

/** The double nearest to n * 2^bits. */
function toDouble(n, bits) {
  const [m, e] = parts(n);
  return scaled(m, e + bits);
}

/** The double nearest to n / d * 2^bits. */
function quotient(n, d, bits) {
  const [m, e] = parts(n);
  const [k, f] = parts(d);
  return scaled(m / k, e - f + bits);
}

/** The integer nearest to x * 2^bits. */
function fromDouble(x, bits) {
  if (x === 0) return 0n;
  const e = 60 - Math.floor(Math.log2(Math.abs(x)));
  return shifted(BigInt(Math.round(scaled(x, e))), bits - e);
}

/**
 * The coefficients of f((T + S) / 2^q) as a polynomial in S, times a positive power of two
 * that depends only on q and on the number of coefficients.
 */
function aroundTime(f, T, q) {
  const n = f.length - 1;
  const a = f.map((c, i) => c << BigInt(q >= 0 ? q * (n - i) : -q * i));
  for (let i = 0; i < n; i += 1) {
    for (let j = n - 1; j >= i; j -= 1) a[j] += T * a[j + 1];
  }
  return a;
}

/** f(t) * g(t) for lists of coefficients. */
function product(f, g) {
  const result = Array(f.length + g.length - 1).fill(0n);
  f.forEach((a, i) => g.forEach((b, j) => { result[i + j] += a * b; }));
  return result;
}

/** n / d * 2^bits in decimals, with a number of significant digits. */
function decimal(n, d, bits, digits) {
  if (n === 0n) return "0";
  const minus = n < 0n !== d < 0n ? "−" : "";
  let [num, den] = [n < 0n ? -n : n, d < 0n ? -d : d];
  if (bits >= 0) num <<= BigInt(bits);
  else den <<= BigInt(-bits);
  let exponent = num.toString().length - den.toString().length;
  if (num * 10n ** BigInt(Math.max(-exponent, 0)) < den * 10n ** BigInt(Math.max(exponent, 0))) {
    exponent -= 1;
  }
  const k = digits - 1 - exponent;
  const [up, down] = [num * 10n ** BigInt(Math.max(k, 0)), den * 10n ** BigInt(Math.max(-k, 0))];
  let text = ((2n * up + down) / (2n * down)).toString();
  if (text.length > digits) {
    exponent += 1;
    text = text.slice(0, digits);
  }
  return minus + placed(text, exponent);
}

/** The digits with a decimal point, the first of them being worth 10^exponent. */
function placed(digits, exponent) {
  if (exponent < -7 || exponent >= Math.max(17, digits.length)) {
    const rest = digits.slice(1).replace(/0+$/, "");
    return `${digits[0]}${rest ? `.${rest}` : ""}e${exponent}`;
  }
  if (exponent < 0) return `0.${"0".repeat(-exponent - 1)}${digits}`;
  if (exponent + 1 >= digits.length) return digits.padEnd(exponent + 1, "0");
  return `${digits.slice(0, exponent + 1)}.${digits.slice(exponent + 1)}`;
}

/** "p/q" or "p" as [p, q]. */
function fraction(text) {
  const [p, q] = text.split("/");
  return [BigInt(p), BigInt(q ?? 1)];
}

/** p / q * 2^bits, rounded down. */
function fixed(text, bits) {
  const [p, q] = fraction(text);
  const [n, d] = bits >= 0 ? [p << BigInt(bits), q] : [p, q << BigInt(-bits)];
  return n >= 0n || n % d === 0n ? n / d : n / d - 1n;
}
