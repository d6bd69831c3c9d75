//! Loops over independent items on all threads of the current pool.
//!
//! A loop of rayon's iterators is compiled for every function that it calls, ten kilobytes each; here
//! the scheduling is compiled once, and what is compiled for each loop is the loop. It costs a lock and a
//! call per item, which items of a microsecond do not notice. Loops whose items are shorter, and those
//! that keep sums for each thread, stay with rayon.

use std::mem;
use std::sync::{Mutex, PoisonError};

use rayon::prelude::*;

/// An item before its turn, and what became of it.
enum Slot<I, T> {
    Waiting(I),
    Taken,
    Done(T),
}

/// What a function makes of each item, in the order of the items.
pub fn map<I: Send, T: Send>(
    items: impl IntoIterator<Item = I>,
    of: impl Fn(I) -> T + Sync,
) -> Vec<T> {
    let slots: Vec<Mutex<Slot<I, T>>> =
        items.into_iter().map(|item| Mutex::new(Slot::Waiting(item))).collect();
    each(slots.len(), &|place| {
        // no two calls have the same place: the lock is never waited for
        let mut slot = slots[place].lock().unwrap_or_else(PoisonError::into_inner);
        if let Slot::Waiting(item) = mem::replace(&mut *slot, Slot::Taken) {
            *slot = Slot::Done(of(item));
        }
    });
    let done = slots.into_iter().filter_map(|slot| {
        match slot.into_inner().unwrap_or_else(PoisonError::into_inner) {
            Slot::Done(value) => Some(value),
            Slot::Waiting(_) | Slot::Taken => None,
        }
    });
    done.collect()
}

/// The same with room to work in, of which no more are made than calls go on at a time.
pub fn map_with<W: Send, I: Send, T: Send>(
    items: impl IntoIterator<Item = I>,
    room: impl Fn() -> W + Sync,
    of: impl Fn(&mut W, I) -> T + Sync,
) -> Vec<T> {
    let rooms: Mutex<Vec<W>> = Mutex::new(Vec::new());
    map(items, |item| {
        let free = rooms.lock().unwrap_or_else(PoisonError::into_inner).pop();
        let mut own = free.unwrap_or_else(&room);
        let value = of(&mut own, item);
        rooms.lock().unwrap_or_else(PoisonError::into_inner).push(own);
        value
    })
}

/// Calls a function with every number below `count`.
fn each(count: usize, of: &(dyn Fn(usize) + Sync)) {
    (0..count).into_par_iter().for_each(of);
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::sync::atomic::{AtomicUsize, Ordering};

    /// A thousand items that move, within one another, in their order; and places that are written to.
    #[test]
    fn items_keep_their_order() {
        let texts = (0..1000).map(|n| n.to_string());
        let found = map(texts, |text| map(0..text.len(), |n| text[n..].to_owned()).join(","));
        assert_eq!((found[7].as_str(), found[123].as_str()), ("7", "123,23,3"));
        assert_eq!(found.len(), 1000);
        let mut values = vec![1.0; 100];
        map(values.iter_mut().enumerate(), |(n, value)| *value += n as f64);
        assert!(values.iter().enumerate().all(|(n, value)| *value == 1.0 + n as f64));
        assert!(map(Vec::<u8>::new(), |n| n).is_empty());
    }

    /// No more rooms than threads, and every item has one to itself.
    #[test]
    fn rooms_are_used_again() {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(3).build().unwrap();
        let made = AtomicUsize::new(0);
        let room = || {
            made.fetch_add(1, Ordering::Relaxed);
            Vec::new()
        };
        let of = |room: &mut Vec<usize>, n: usize| {
            room.clear();
            room.extend(0..n);
            room.len()
        };
        let found = pool.install(|| map_with(0..1000, room, of));
        assert!(found.into_iter().eq(0..1000));
        assert!((1..=3).contains(&made.load(Ordering::Relaxed)));
    }
}
