use super::super::arena::{Arena, Expr, Input, Stage};
use super::super::processor::{Order, Processor};
use super::{Cost, Time, time};

/// So many inputs.
fn inputs(arena: &mut Arena, count: u32) -> Vec<Expr> {
    let inputs = (0..count).map(|place| arena.input(Input::Coordinate(place)));
    inputs.collect()
}

fn of(arena: &Arena, outputs: &[Expr], processor: &Processor) -> Time {
    time(arena, outputs, Stage::State, processor)
}

/// The x86 of the table, by its ports alone.
fn by_ports(arena: &Arena, outputs: &[Expr]) -> Time {
    of(arena, outputs, &Processor::X86_64_V3)
}

#[test]
fn a_product_that_one_sum_uses_is_one_operation_with_it() {
    let mut arena = Arena::new();
    let x = inputs(&mut arena, 3);
    let product = arena.mul(x[0], x[1]);
    let sum = arena.add(product, x[2]);
    // A load, and four cycles.
    assert_eq!(by_ports(&arena, &[sum]).path, 5 + 4);
    // An output is there by itself: then they are two.
    assert_eq!(by_ports(&arena, &[sum, product]).path, 5 + 3 + 3);
}

#[test]
fn units_are_busy_and_chains_wait() {
    let mut arena = Arena::new();
    let x = inputs(&mut arena, 12);
    let squares: Vec<Expr> = x.iter().map(|&x| arena.square(x)).collect();
    let mut quotients = squares.clone();
    for quotient in &mut quotients {
        *quotient = arena.reciprocal(*quotient);
    }
    let product = quotients[1..]
        .iter()
        .fold(quotients[0], |product, &next| arena.mul(product, next));
    let Time { units, path, call } = by_ports(&arena, &[product]);
    // Twelve reciprocals of four cycles each; twelve squares and eleven products on two units.
    assert_eq!(units, 12 * 4);
    assert_eq!(path, 5 + 3 + 14 + 11 * 3);
    assert_eq!(call, units + path / 2 + 6);
}

/// Two units take products and two take sums, and one of them takes both.
#[test]
fn products_and_sums_share_a_unit() {
    let mut arena = Arena::new();
    let x = inputs(&mut arena, 2);
    let sums = (0..20).fold([x[0], x[1]], |[a, b], _| [b, arena.add(a, b)]);
    assert_eq!(by_ports(&arena, &sums[1..]).units, 10);
    let products = (0..20).fold([x[0], x[1]], |[a, b], _| [b, arena.mul(a, b)]);
    assert_eq!(by_ports(&arena, &products[1..]).units, 10);
    let both = [sums[1], products[1]];
    assert_eq!(by_ports(&arena, &both).units, 40_usize.div_ceil(3));
}

#[test]
fn what_does_nothing_takes_nothing() {
    let mut arena = Arena::new();
    let x = inputs(&mut arena, 2);
    assert_eq!(by_ports(&arena, &x), Time::default());
    assert_eq!(by_ports(&arena, &[Arena::ZERO]), Time::default());
}

#[test]
fn what_is_known_earlier_is_loaded() {
    let mut arena = Arena::new();
    let mass = arena.input(Input::Symbol(0));
    let weight = arena.mul(mass, mass);
    let x = inputs(&mut arena, 1);
    let force = arena.mul(weight, x[0]);
    // Two loads of two cycles, a product, a store of two cycles.
    assert_eq!(of(&arena, &[force], &Processor::CORTEX_M4F).call, 4 + 1 + 2);
    let all = time(&arena, &[force], Stage::Parameter, &Processor::CORTEX_M4F);
    assert_eq!(all.call, 4 + 2 + 2);
}

#[test]
fn in_order_the_path_counts_nothing() {
    let mut arena = Arena::new();
    let x = inputs(&mut arena, 4);
    let pairs = [arena.add(x[0], x[1]), arena.add(x[2], x[3])];
    let tree = arena.add(pairs[0], pairs[1]);
    let mut chain = x[0];
    for &next in &x[1..] {
        chain = arena.add(chain, next);
    }
    for processor in [&Processor::CORTEX_M4F, &Processor::CORTEX_M7] {
        let [tree, chain] = [tree, chain].map(|output| of(&arena, &[output], processor));
        assert_eq!(tree.call, chain.call);
        assert!(tree.path < chain.path);
    }
    let [tree, chain] = [tree, chain].map(|output| by_ports(&arena, &[output]));
    assert_eq!(tree.units, chain.units);
    assert!(tree.call < chain.call);
}

#[test]
fn products_and_sums_are_apart_where_nothing_fuses_them() {
    let mut arena = Arena::new();
    let x = inputs(&mut arena, 3);
    let product = arena.mul(x[0], x[1]);
    let sum = arena.add(product, x[2]);
    assert_eq!(
        of(&arena, &[sum], &Processor::CORTEX_M4F).call,
        3 * 2 + 2 + 2
    );
    assert_eq!(of(&arena, &[sum], &Processor::CORTEX_M7).path, 1 + 3 + 3);
}

/// Sums of neighbours, all of which are there before the first is used again.
fn kept(arena: &mut Arena, count: usize) -> Expr {
    let x = inputs(arena, count as u32 + 1);
    let sums: Vec<Expr> = x.windows(2).map(|x| arena.add(x[0], x[1])).collect();
    let backwards = sums.iter().rev();
    backwards.fold(Arena::ONE, |product, &sum| arena.mul(product, sum))
}

#[test]
fn what_does_not_stand_in_registers_is_stored_and_loaded() {
    // Every value is stored once and loaded once. In order that takes four cycles each.
    let table = |registers| Processor {
        registers,
        ..Processor::CORTEX_M4F
    };
    for count in [8, 16, 17, 20] {
        let mut arena = Arena::new();
        let product = kept(&mut arena, count);
        let [roomy, narrow] = [64, 16].map(|k| of(&arena, &[product], &table(k)).call);
        assert_eq!(narrow - roomy, 4 * count.saturating_sub(16), "{count}");
    }
}

#[test]
fn long_code_comes_from_afar() {
    let table = |at_most| {
        let mut processor = Processor::X86_64_V3;
        if let Order::OutOfOrder { cached, .. } = &mut processor.order {
            *cached = at_most;
        }
        processor
    };
    let mut arena = Arena::new();
    let product = kept(&mut arena, 20);
    let steps = 20 + 19;
    let [short, long] = [steps, steps - 1].map(|cached| of(&arena, &[product], &table(cached)));
    assert_eq!(long.call - short.call, steps * 3 / 4);
    assert_eq!((long.units, long.path), (short.units, short.path));
}

#[test]
fn a_cost_has_both() {
    let mut arena = Arena::new();
    let x = inputs(&mut arena, 3);
    let product = arena.mul(x[0], x[1]);
    let sum = arena.add(product, x[2]);
    let cost = Cost::of(&arena, &[sum], Stage::State);
    assert_eq!((cost.count.total(), cost.count.depth), (2, 2));
    // A load for each of two cycles on two units, half of a path of nine, an output.
    assert_eq!(cost.cycles, 2 + 4 + 6);
}
