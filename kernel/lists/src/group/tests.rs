use super::*;
use bytemuck::Zeroable;
use oktant_shared::adaptive::{SINGLE, entry};

fn frame(first_sample: u32, sample_count: u32) -> Frame {
    Frame {
        most_samples: 64,
        first_sample,
        sample_count,
        is_listed: 1,
        ..Frame::zeroed()
    }
}

/// What an invocation of each number puts into the workgroup's memory.
fn of_each<T: Copy + Default>(value: impl Fn(u32) -> T) -> OfEach<T> {
    let mut all = [T::default(); LIST_GROUP as usize];
    for (place, number) in all.iter_mut().zip(0..) {
        *place = value(number);
    }
    all
}

/// A pixel after another, each of another level.
fn list(pixels: u32) -> Vec<u32> {
    (0..pixels).map(|index| entry(index, SINGLE + index * 7 % 4)).collect()
}

/// Oracle: one sample after the other, in the order of the list.
#[test]
fn each_sample_is_taken_once_and_added_in_its_order() {
    for (first_sample, sample_count) in [(0, 64), (0, 1), (1, 1), (16, 16), (0, 3), (60, 4)] {
        let frame = frame(first_sample, sample_count);
        for pixels in [1, 31, 32, 33, 200] {
            let list = list(pixels);
            let mut picture = vec![Vec4::splat(100.0); list.len()];
            let mut work = vec![Vec4::splat(10.0); list.len()];
            let mut marks = vec![Mark::BLANK; list.len()];
            let mut orders = vec![Vec::new(); list.len()];
            for group in 0..pixels.div_ceil(pixels_of_group(&frame)) {
                let stretch = Stretch {
                    frame: &frame,
                    list: &list,
                    count: &[pixels],
                    first: group * pixels_of_group(&frame),
                };
                let looks = of_each(|invocation| stretch.looks(invocation));
                let ends = of_each(|invocation| summed(&frame, &looks, invocation));
                let all = ends[ends.len() - 1];
                for turn in (0..all.max(1)).step_by(LIST_GROUP as usize) {
                    let [mut sums, mut costs] = [(); 2].map(|()| of_each(|_| Vec4::NAN));
                    let mut words = of_each(|_| UVec4::MAX);
                    let mut found = Found {
                        sums: &mut sums,
                        costs: &mut costs,
                        marks: &mut words,
                    };
                    for invocation in 0..LIST_GROUP.min(all.saturating_sub(turn)) {
                        let look = turn + invocation;
                        let place = owner(&ends, look);
                        let number = look - start(&ends, place);
                        let Listed { index, batch } = stretch.pixel(place);
                        orders[index as usize].push(batch.first + number);
                        let value = (batch.first + number) as f32;
                        found.put(
                            invocation,
                            Pixel {
                                sum: Vec4::new(value, 0.1, 0.0, 1.0),
                                work: Vec4::X,
                                mark: Mark {
                                    seen: index,
                                    nearness: value,
                                    ..Mark::of_level(&frame, of_entry(list[index as usize]).1)
                                },
                            },
                        );
                    }
                    for invocation in 0..LIST_GROUP {
                        found.add(&stretch, &ends, turn, invocation, &mut picture, &mut work, &mut marks);
                    }
                }
            }
            for (index, order) in orders.iter().enumerate() {
                let batch = samples_at(of_entry(list[index]).1).among(&frame);
                let wanted: Vec<u32> = (batch.first..batch.first + batch.count).collect();
                assert_eq!(*order, wanted, "pixel {index} of {pixels}");
                let is_new = batch.first == 0 && batch.count > 0;
                let start = if is_new { Vec4::ZERO } else { Vec4::splat(100.0) };
                let terms = wanted.iter().map(|number| Vec4::new(*number as f32, 0.1, 0.0, 1.0));
                assert_eq!(
                    picture[index],
                    terms.fold(start, |sum, term| sum + term),
                    "pixel {index}"
                );
                assert_eq!(work[index].x, 10.0 + batch.count as f32, "pixel {index}");
                // What the middle sees is kept but of a pixel's only sample.
                let is_marked = batch.samples == 1 && batch.count > 0;
                assert_eq!(
                    marks[index].seen,
                    if is_marked { index as u32 } else { 0 },
                    "pixel {index}"
                );
            }
        }
    }
}

/// Beyond the end of its buffers an invocation writes nothing.
#[test]
fn buffers_may_be_short() {
    let frame = frame(0, 4);
    let list = [entry(3, SINGLE)];
    let stretch = Stretch {
        frame: &frame,
        list: &list,
        count: &[1],
        first: 0,
    };
    let ends = of_each(|_| 1);
    let [mut sums, mut costs] = [(); 2].map(|()| of_each(|_| Vec4::ONE));
    let mut words = of_each(|_| UVec4::ONE);
    let found = Found {
        sums: &mut sums,
        costs: &mut costs,
        marks: &mut words,
    };
    let (mut picture, mut work, mut marks) = ([Vec4::ZERO; 3], [Vec4::ZERO; 1], [Mark::BLANK; 3]);
    found.add(&stretch, &ends, 0, 0, &mut picture, &mut work, &mut marks);
    assert_eq!(
        (picture, work, marks),
        ([Vec4::ZERO; 3], [Vec4::ZERO; 1], [Mark::BLANK; 3])
    );
}
