//! Movies from pictures: animated GIF, which every browser and slide program shows, or animated PNG.
//!
//! All frames have one palette, so that nothing flickers: the colors that fill most of the movie, which are those of phases and solids, are exact, and what lies
//! between them at smoothed edges is one of their neighbors. A frame is written as the rectangle in which it differs from the one before, transparent where it does not.

mod apng;
mod error;
mod frame;
mod gif;
mod palette;

pub use self::error::MovieError;

use self::frame::{Difference, Run, difference};
use self::palette::Palette;
use super::picture::Picture;

/// A format of movies.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Format {
    /// Animated GIF.
    Gif,
    /// Animated PNG.
    Apng,
}

/// The frames of a movie.
#[derive(Debug, Default)]
pub struct Movie {
    size: [u32; 2],
    /// Runs of each frame with the number of times that it is shown.
    frames: Vec<(Vec<Run>, u32)>,
}

impl Movie {
    /// Number of frames that differ.
    pub fn len(&self) -> usize {
        self.frames.len()
    }

    /// Adds a picture to be shown for some durations of one; if it equals the last one, that is shown longer.
    ///
    /// # Errors
    /// [`MovieError::Size`].
    pub fn push(&mut self, picture: &Picture, times: u32) -> Result<(), MovieError> {
        if self.frames.is_empty() {
            self.size = picture.size;
        } else if self.size != picture.size {
            return Err(MovieError::Size { expected: self.size, found: picture.size });
        }
        let runs: Vec<Run> = picture.colors.chunk_by(|a, b| a == b).map(|run| (run[0], run.len() as u32)).collect();
        match self.frames.last_mut() {
            Some((last, shown)) if *last == runs => *shown += times,
            _ => self.frames.push((runs, times)),
        }
        Ok(())
    }

    /// The file at `rate` pictures per second; the last one stays for `rest` in s before it begins again.
    ///
    /// # Errors
    /// [`MovieError`].
    pub fn encoded(mut self, format: Format, rate: f64, rest: f64) -> Result<Vec<u8>, MovieError> {
        let Some((_, shown)) = self.frames.last_mut() else { return Err(MovieError::Empty) };
        *shown += (rest * rate).ceil() as u32;
        let palette = Palette::of(self.frames.iter().flat_map(|(runs, _)| runs));
        match format {
            Format::Gif => gif::encoded(self.size, &palette, self.differences(&palette), rate),
            Format::Apng => apng::encoded(self.size, &palette, self.differences(&palette), rate, self.frames.len()),
        }
    }

    /// The frames, each as what differs from the one before.
    fn differences<'a>(&'a self, palette: &'a Palette) -> impl Iterator<Item = Difference> + 'a {
        let mut before: Option<Vec<u8>> = None;
        self.frames.iter().map(move |(runs, shown)| {
            let count = |run: &Run| run.1 as usize;
            let now: Vec<u8> =
                runs.iter().flat_map(|run| std::iter::repeat_n(palette.index(run.0), count(run))).collect();
            let found = difference(self.size, before.as_deref(), &now, *shown);
            before = Some(now);
            found
        })
    }
}

#[cfg(test)]
mod tests {
    use super::frame::Rgb;
    use super::*;

    const SIZE: [u32; 2] = [8, 4];

    /// A row of colors that moves by one column per frame over a ground.
    fn pictures() -> Vec<Picture> {
        let frame = |k: usize| {
            let color = |at: usize| if at % 8 == k && at / 8 > 0 { [200, at as u8, 0] } else { [9, 9, 9] };
            Picture { size: SIZE, colors: (0..32).map(color).collect() }
        };
        [0, 1, 1, 2].map(frame).to_vec()
    }

    fn movie() -> Movie {
        let mut movie = Movie::default();
        pictures().iter().for_each(|picture| movie.push(picture, 1).unwrap());
        movie
    }

    /// Plays frames of colors with alpha, each in its rectangle over those before.
    fn played(frames: Vec<([usize; 2], [usize; 2], Vec<u8>)>) -> Vec<Vec<Rgb>> {
        let mut screen = vec![[0; 3]; 32];
        let mut play = |([left, top], [width, height], pixels): ([usize; 2], [usize; 2], Vec<u8>)| {
            assert_eq!(pixels.len(), 4 * width * height);
            for (k, pixel) in pixels.as_chunks::<4>().0.iter().enumerate().filter(|(_, pixel)| pixel[3] > 0) {
                screen[(top + k / width) * 8 + left + k % width] = [pixel[0], pixel[1], pixel[2]];
            }
            screen.clone()
        };
        frames.into_iter().map(&mut play).collect()
    }

    fn expected() -> Vec<Vec<Rgb>> {
        let mut expected: Vec<_> = pictures().into_iter().map(|picture| picture.colors).collect();
        expected.dedup();
        expected
    }

    #[test]
    fn a_gif_plays_the_pictures_again_and_a_repeated_one_longer() {
        assert_eq!(movie().len(), 3);
        let file = movie().encoded(Format::Gif, 12.0, 1.0).unwrap();
        let mut options = ::gif::DecodeOptions::new();
        options.set_color_output(::gif::ColorOutput::RGBA);
        let mut decoder = options.read_info(&file[..]).unwrap();
        let (mut frames, mut delays) = (Vec::new(), Vec::new());
        while let Some(frame) = decoder.read_next_frame().unwrap() {
            let [left, top, width, height] = [frame.left, frame.top, frame.width, frame.height].map(usize::from);
            frames.push(([left, top], [width, height], frame.buffer.to_vec()));
            delays.push(frame.delay);
        }
        assert_eq!(frames[1].1, [2, 3], "only what changes is written");
        assert_eq!((played(frames), delays), (expected(), vec![8, 17, 108]));
    }

    #[test]
    fn an_animated_png_plays_the_pictures_again() {
        let file = movie().encoded(Format::Apng, 12.0, 1.0).unwrap();
        let mut decoder = png::Decoder::new(std::io::Cursor::new(&file));
        decoder.set_transformations(png::Transformations::EXPAND | png::Transformations::ALPHA);
        let mut reader = decoder.read_info().unwrap();
        let mut frames = Vec::new();
        for _ in 0..3 {
            let mut pixels = vec![0; reader.output_buffer_size().unwrap()];
            let info = reader.next_frame(&mut pixels).unwrap();
            let control = *reader.info().frame_control().unwrap();
            pixels.truncate(info.buffer_size());
            let numbers = [control.x_offset, control.y_offset, control.width, control.height].map(|n| n as usize);
            frames.push(([numbers[0], numbers[1]], [numbers[2], numbers[3]], pixels));
        }
        assert_eq!(played(frames), expected());
    }

    #[test]
    fn no_frames_and_frames_of_other_sizes_are_refused() {
        assert!(matches!(Movie::default().encoded(Format::Gif, 12.0, 1.0), Err(MovieError::Empty)));
        let other = Picture { size: [4, 8], ..pictures()[0].clone() };
        assert!(movie().push(&other, 1).unwrap_err().to_string().contains("[4, 8]"));
    }
}
