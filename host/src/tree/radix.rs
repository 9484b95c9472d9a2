//! A parallel radix sort.

use super::pages::zeroed;
use rayon::prelude::*;
use std::sync::atomic::{AtomicU64, Ordering::Relaxed};

/// Bits by which one pass sorts.
const DIGIT: u32 = 11;
/// Words that are worth a thread.
const LEAST: usize = 1 << 14;

/// Words that ascend in their bits from `low` on, of which there are `bits`, and that ascend below; sorted.
///
/// From the least digit up, each pass stable. Threads write to places of their own among the same words: atomic ones,
/// for it is only known at run time that no two write to the same; relaxed stores cost no more than others.
pub(super) fn sorted(mut words: Vec<u64>, low: u32, bits: u32) -> Vec<u64> {
    if words.len() < LEAST {
        words.sort_unstable();
        return words;
    }
    let mut words: Vec<AtomicU64> = words.into_iter().map(AtomicU64::new).collect();
    let chunk = words.len().div_ceil(rayon::current_num_threads()).max(LEAST);
    let mut other: Vec<AtomicU64> = zeroed(words.len());
    let mut shift = low;
    while shift < low + bits {
        let width = DIGIT.min(low + bits - shift);
        let digit = |word: &AtomicU64| (word.load(Relaxed) >> shift) as usize & ((1 << width) - 1);
        let mut places: Vec<Vec<u32>> = words
            .par_chunks(chunk)
            .map(|words| {
                let mut counts = vec![0; 1 << DIGIT];
                for word in words {
                    counts[digit(word)] += 1;
                }
                counts
            })
            .collect();
        let mut next = 0;
        for digit in 0..1 << width {
            for places in &mut places {
                let count = places[digit];
                places[digit] = next;
                next += count;
            }
        }
        words.par_chunks(chunk).zip(&mut places).for_each(|(words, places)| {
            for word in words {
                let place = &mut places[digit(word)];
                other[*place as usize].store(word.load(Relaxed), Relaxed);
                *place += 1;
            }
        });
        std::mem::swap(&mut words, &mut other);
        shift += width;
    }
    words.into_iter().map(AtomicU64::into_inner).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn words_are_sorted_by_their_high_bits_and_stay_in_order_otherwise() {
        const LOW: u32 = 18;
        let mut state = 1_u64;
        let words: Vec<u64> = (0..200_000_u64)
            .map(|index| {
                state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1);
                // Few enough keys that many are equal.
                (state >> 47) << LOW | index
            })
            .collect();
        let mut expected = words.clone();
        expected.sort_unstable();
        assert_eq!(sorted(words, LOW, 17), expected);
    }
}
