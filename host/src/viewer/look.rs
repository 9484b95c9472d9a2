//! What the person asked for about the picture.

use crate::standpoint::Origin;
use crate::view::View;
use std::fmt;
use std::sync::Arc;

/// What changes the view that comes with whatever is loaded into the one that the window opens with.
#[derive(Clone)]
pub struct Look(Arc<Change>);

/// What becomes of the view of a scene whose places are counted from there.
type Change = dyn Fn(View, &Origin) -> View + Send + Sync;

impl Look {
    /// A change of views.
    pub fn new(change: impl Fn(View, &Origin) -> View + Send + Sync + 'static) -> Self {
        Look(Arc::new(change))
    }

    /// The changed view of a scene whose places are counted from there.
    pub fn applied(&self, view: View, origin: &Origin) -> View {
        (self.0)(view, origin)
    }
}

impl Default for Look {
    /// Changes nothing.
    fn default() -> Self {
        Look::new(|view, _| view)
    }
}

impl fmt::Debug for Look {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "Look of {:?}", self.applied(View::default(), &Origin::default()))
    }
}
