//! Odd budgets: each is refused with a question or a mistake that names what is odd, and none comes in wrong.

use super::*;
