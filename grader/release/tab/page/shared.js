// The memory that the page and Python's worker share.
// signals, Int32: [0] is Python's interrupt, [REQUEST] counts beginnings and ends of requests of
// the grader, [ALLOWED_MS] is how long the one at work may take, 0 between two,
// [STOP] is 1 once somebody has stopped the checks.
export const REQUEST = 1, ALLOWED_MS = 2, STOP = 3, SIGNALS = 4;
// ring, Int32: [HEAD] is the slot that the page writes next, [TAIL] the one that Python reads next;
// behind them are the slots, each an event: its type in pygame and three numbers.
export const HEAD = 0, TAIL = 1, SLOTS = 256, NUMBERS = 4;
export const EVENT = (slot) => 2 + slot * NUMBERS;
export const RING = 2 + SLOTS * NUMBERS;

export const shareNumbers = (count) => new Int32Array(new SharedArrayBuffer(4 * count));
