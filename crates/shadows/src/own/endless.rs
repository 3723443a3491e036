//! Loops that nothing can end. A driver may wait for one forever, or (lavapipe) give it up after 65535
//! rounds and go on with whatever value it had.

use naga::{Block, Expression, Function, Literal, Module, Span, Statement};

/// The first loop of a module without a way out.
pub(super) fn endless_loop(module: &Module) -> Option<Span> {
    module.functions.iter().find_map(|(_, function)| in_block(function, &function.body))
}

fn in_block(function: &Function, block: &Block) -> Option<Span> {
    block.span_iter().find_map(|(statement, span)| match statement {
        Statement::Loop { body, break_if: None, .. } if !leaves(function, body, Exit::Any) => Some(*span),
        Statement::Loop { body, continuing, .. } => {
            in_block(function, body).or_else(|| in_block(function, continuing))
        }
        _ => inner(function, statement).into_iter().find_map(|b| in_block(function, b)),
    })
}

/// What counts as leaving a loop.
#[derive(Clone, Copy, PartialEq)]
enum Exit {
    /// `break` and `return`.
    Any,
    /// `return` alone: a `break` here belongs to something further in.
    Return,
}

/// Whether a block may leave the loop that it is in.
fn leaves(function: &Function, block: &Block, exit: Exit) -> bool {
    block.iter().any(|statement| match statement {
        Statement::Return { .. } | Statement::Kill => true,
        Statement::Break => exit == Exit::Any,
        Statement::Loop { body, .. } => leaves(function, body, Exit::Return),
        Statement::Switch { .. } => {
            inner(function, statement).into_iter().any(|b| leaves(function, b, Exit::Return))
        }
        _ => inner(function, statement).into_iter().any(|b| leaves(function, b, exit)),
    })
}

/// The blocks of a statement that may run: of `if true`, one.
fn inner<'a>(function: &Function, statement: &'a Statement) -> Vec<&'a Block> {
    match statement {
        Statement::Block(block) => vec![block],
        Statement::If { condition, accept, reject } => match function.expressions[*condition] {
            Expression::Literal(Literal::Bool(true)) => vec![accept],
            Expression::Literal(Literal::Bool(false)) => vec![reject],
            _ => vec![accept, reject],
        },
        Statement::Switch { cases, .. } => cases.iter().map(|case| &case.body).collect(),
        _ => vec![],
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn is_endless(body: &str) -> bool {
        let source = format!("fn f(x: i32) -> i32 {{ var i = x; {body} return i; }}");
        endless_loop(&naga::front::wgsl::parse_str(&source).expect("parses")).is_some()
    }

    #[test]
    fn loops_that_may_end_are_let_be() {
        for body in [
            "loop { i++; if i > 9 { break; } }",
            "loop { i++; continuing { break if i > 9; } }",
            "while i < 9 { i++; }",
            "for (var k = 0; k < 9; k++) { i += k; }",
            "while true { if i > 9 { return i; } i++; }",
            "loop { loop { if i > 9 { return i; } i++; } }",
        ] {
            assert!(!is_endless(body), "{body}");
        }
    }

    #[test]
    fn loops_that_cannot_end_are_found() {
        for body in [
            "loop { i++; }",
            "while true { i++; }",
            "for (;;) { i++; }",
            "loop { loop { break; } }",
            "loop { switch i { case 1: { break; } default: { i++; } } }",
            "if i > 3 { while i < 9 { loop { i++; } } }",
        ] {
            assert!(is_endless(body), "{body}");
        }
    }
}
