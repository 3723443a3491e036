//! Where in a list a triangle stands.

/// Slots to a page.
const PAGE: usize = 32;

/// Not in the list.
const NOWHERE: u32 = u32::MAX;

/// Places by slots. Neighbours in the tree have neighbouring slots, so that few pages are needed, and none is looked
/// for in a hash table. Emptied in no time, as a sparse set is (Briggs and Torczon 1993): a page counts only if it
/// says itself which one it is.
#[derive(Default)]
pub(super) struct Whereabouts {
    /// Of each page that there may be: where it was when it was last used.
    page: Vec<u32>,
    numbers: Vec<u32>,
    pages: Vec<[u32; PAGE]>,
}

impl Whereabouts {
    pub(super) fn clear(&mut self, slots: usize) {
        self.page.resize(slots.div_ceil(PAGE), 0);
        self.numbers.clear();
        self.pages.clear();
    }

    #[inline(always)]
    fn page(&self, slot: u32) -> Option<usize> {
        let number = slot as usize / PAGE;
        let page = self.page[number] as usize;
        (self.numbers.get(page) == Some(&(number as u32))).then_some(page)
    }

    #[inline(always)]
    pub(super) fn set(&mut self, slot: u32, place: u32) {
        let page = self.page(slot).unwrap_or_else(|| {
            let number = slot as usize / PAGE;
            self.page[number] = self.pages.len() as u32;
            self.numbers.push(number as u32);
            self.pages.push([NOWHERE; PAGE]);
            self.pages.len() - 1
        });
        self.pages[page][slot as usize % PAGE] = place;
    }

    #[inline(always)]
    pub(super) fn find(&self, slot: u32) -> Option<u32> {
        let place = self.pages[self.page(slot)?][slot as usize % PAGE];
        (place != NOWHERE).then_some(place)
    }
}
