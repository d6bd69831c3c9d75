//! A record as a figure: waveform with its fit, what the fit leaves, and spectra.

use crate::table::unit_text;
use plotters::element::{PathElement, Polygon};
use plotters::style::Color;

use super::ObservationReport;
use crate::html::Drawing;
use crate::number::significant;
use crate::plain;
use crate::plot::{
    AFTER, Area, Axis, BEFORE, Chart, Drawn, EVEN, Fill, INK, Panel, Titles, mark, px, stroke,
    svg_with_titles,
};
use crate::printed::grouped;
use crate::table::in_unit;
use gumption_signal::{
    Amplitude, Channel, ChannelObservation, RecordTrace, SampleRanges, SpectrumColumn,
};

/// Heights of panels in pixels.
const TALL: f64 = 190.0;
const SPECTRUM: f64 = 230.0;

/// Width from which waveform and residuals stand beside each other.
const BESIDE: f64 = 500.0;

/// Samples that are drawn as dots, at most.
const DOTS: usize = 160;

/// How far below the greatest amplitude a spectrum is drawn, at most.
const DEEPEST: f64 = 1e-9;

/// What figures show beside their marks.
struct ChannelFigures<'a> {
    trace: &'a RecordTrace,
    channel: &'a Channel,
    /// What peak values are multiplied by.
    factor: f64,
    spurious: Vec<(f64, f64)>,
}

/// The figure of a channel of a row; `None` where there is nothing to see. `at` are the row's
/// conditions in words.
pub(super) fn record(
    observed: &ObservationReport<'_>,
    trace: &RecordTrace,
    (at, channels): (&str, &[ChannelObservation]),
) -> Option<Drawing> {
    let channel = observed.settings.channels.get(trace.channel)?;
    let found = channels.iter().find(|of| of.channel == trace.channel)?;
    let factor = observed.settings.amplitude.factor();
    let spurious = found.spurious.iter();
    let spurious: Vec<(f64, f64)> =
        spurious.map(|of| (of.cycles * found.rate.value, factor * of.amplitude)).collect();
    let has_spurious = !spurious.is_empty();
    let shown = ChannelFigures { trace, channel, factor, spurious };
    let waveform = shown.waveform()?;
    let residuals = shown.residuals()?;
    let spectrum = shown.spectrum();
    let drawn = |width: f64| {
        let beside = width >= BESIDE;
        let above = if beside { TALL } else { 2.0 * TALL };
        let below = if spectrum.is_some() { SPECTRUM } else { 0.0 };
        svg_with_titles(width, above + below, |area, titles| {
            let (top, bottom) = area.split_vertically(px(above));
            let parts = top.split_evenly(if beside { (1, 2) } else { (2, 1) });
            let [left, right] = parts.as_slice() else { return Ok(()) };
            shown.draw_waveform(left, &waveform)?;
            shown.draw_residuals(right, &residuals)?;
            match &spectrum {
                Some(axes) => shown.draw_spectrum(&bottom, axes, titles),
                None => Ok(()),
            }
        })
    };
    let values = if shown.is_dotted() {
        "samples (dots)".to_owned()
    } else {
        format!("least and greatest of each {} samples (area)", grouped(trace.waveform.samples))
    };
    let each = match trace.residuals.samples {
        1 => String::new(),
        several => format!(", least and greatest of each {}", grouped(several)),
    };
    let kind = match observed.settings.amplitude {
        Amplitude::Peak => "peak",
        Amplitude::Rms => "RMS",
    };
    let part = if trace.transformed < trace.samples {
        format!(" of the first {} samples", grouped(trace.transformed))
    } else {
        String::new()
    };
    let marks = if has_spurious { ", triangles: what the fit does not have" } else { "" };
    let spectra = match spectrum {
        Some(_) => format!(
            "; the spectrum of {kind} amplitudes under a Hann window{part} (line) and that of the \
             residuals (area), with the fit's own amplitudes (circle: fundamental, squares: its \
             multiples{marks})"
        ),
        None => String::new(),
    };
    let caption = format!(
        "`{}` at {at}: the first periods, {values}, with the fit (line); what the fit leaves of all {} \
         samples{each}{spectra}.",
        plain(&channel.name),
        grouped(trace.samples)
    );
    Some(Drawing::new(caption.replace('`', ""), drawn))
}

/// The axes of a panel.
struct Axes {
    x: Axis,
    y: Axis,
}

impl ChannelFigures<'_> {
    fn label(&self, what: &str) -> String {
        match self.channel.unit.has_name() {
            true => format!("{what} in {}", unit_text(&self.channel.unit)),
            false => what.to_owned(),
        }
    }

    /// Whether every sample of the waveform is seen.
    fn is_dotted(&self) -> bool {
        let waveform = &self.trace.waveform;
        waveform.samples == 1 && waveform.ranges.len() <= DOTS
    }

    fn waveform(&self) -> Option<Axes> {
        let of = &self.trace.waveform;
        let values = of.ranges.iter().flatten().chain(&self.trace.fit).copied();
        Some(Axes { x: time(of.ranges.len() as f64 * of.step)?, y: Axis::around(values)? })
    }

    fn residuals(&self) -> Option<Axes> {
        let of = &self.trace.residuals;
        let x = time(of.ranges.len() as f64 * of.step)?;
        Some(Axes { x, y: Axis::about_zero(of.ranges.iter().flatten().copied()) })
    }

    /// The axes of the spectra; `None` for records that are too short for one.
    fn spectrum(&self) -> Option<Axes> {
        let columns = &self.trace.spectrum;
        let (first, last) = (columns.first()?, columns.last()?);
        let tones = self.trace.tones.iter().map(|tone| tone.amplitude);
        let greatest = |columns: &[SpectrumColumn]| -> Vec<f64> {
            columns.iter().map(|column| column.amplitudes[1]).collect()
        };
        let all = greatest(columns);
        let top = all.iter().copied().chain(tones).fold(0.0, f64::max);
        let left = greatest(&self.trace.residual_spectrum);
        let least = all.into_iter().chain(left).filter(|amplitude| *amplitude > 0.0);
        let least = least.fold(top, f64::min).max(DEEPEST * top);
        let usable = last.hertz > first.hertz && top > 0.0 && top.is_finite();
        usable.then(|| Axes {
            x: Axis::logarithmic(first.hertz / 1.1, last.hertz * 1.1),
            y: Axis::logarithmic(self.factor * least / 2.0, self.factor * top * 2.0),
        })
    }

    fn draw_waveform(&self, area: &Area<'_>, axes: &Axes) -> Drawn {
        let of = &self.trace.waveform;
        let chart = panel(area, axes, ["time from the first sample in s", &self.label("value")])?;
        if self.is_dotted() {
            for (place, [value, _]) in of.ranges.iter().enumerate() {
                mark(&chart, 0, (place as f64 * of.step, *value), 1.75, (AFTER, Fill::Full))?;
            }
        } else {
            ranges(&chart, of)?;
        }
        let last = of.ranges.len().saturating_sub(1) as f64 * of.step;
        let step = last / self.trace.fit.len().saturating_sub(1).max(1) as f64;
        let fit = self.trace.fit.iter().enumerate();
        let fit: Vec<(f64, f64)> = fit.map(|(place, y)| (place as f64 * step, *y)).collect();
        chart.plotting_area().draw(&PathElement::new(fit, stroke(INK, 1.25)))
    }

    fn draw_residuals(&self, area: &Area<'_>, axes: &Axes) -> Drawn {
        let of = &self.trace.residuals;
        let chart =
            panel(area, axes, ["time from the first sample in s", &self.label("residual")])?;
        ranges(&chart, of)?;
        let ends = axes.x.ends().map(|end| (end, 0.0));
        chart.plotting_area().draw(&PathElement::new(ends.to_vec(), stroke(INK, 0.75)))
    }

    fn draw_spectrum(&self, area: &Area<'_>, axes: &Axes, titles: &mut Titles) -> Drawn {
        let chart = panel(area, axes, ["f in Hz", &self.label("amplitude")])?;
        let [floor, _] = axes.y.ends();
        let y = |amplitude: f64| {
            let amplitude = self.factor * amplitude;
            if amplitude > 0.0 { axes.y.position(amplitude).max(floor) } else { floor }
        };
        let x = |hertz: f64| axes.x.position(hertz);
        let left = &self.trace.residual_spectrum;
        let high = left.iter().map(|of| (x(of.hertz), y(of.amplitudes[1])));
        let low = left.iter().rev().map(|of| (x(of.hertz), floor));
        if left.len() > 1 {
            let corners: Vec<(f64, f64)> = high.chain(low).collect();
            chart.plotting_area().draw(&Polygon::new(corners, EVEN.filled()))?;
        }
        let line = self.trace.spectrum.iter().map(|of| (x(of.hertz), y(of.amplitudes[1])));
        let line: Vec<(f64, f64)> = line.collect();
        chart.plotting_area().draw(&PathElement::new(line, stroke(INK, 1.0)))?;
        let unit = &self.channel.unit;
        let said = |what: &str, hertz: f64, amplitude: f64| {
            let amplitude = in_unit(&significant(amplitude, 4), unit);
            let frequency = significant(hertz, 6);
            let frequency = match frequency.contains('.') && !frequency.contains('e') {
                true => frequency.trim_end_matches('0').trim_end_matches('.'),
                false => &frequency,
            };
            format!("{what}, {frequency} Hz: {amplitude}")
        };
        for tone in &self.trace.tones {
            let place = (x(tone.hertz), y(tone.amplitude));
            let (group, what) = match tone.multiple {
                1 => (0, "fundamental".to_owned()),
                multiple => (1, format!("multiple {multiple}")),
            };
            mark(&chart, group, place, 3.0, (AFTER, Fill::Full))?;
            titles.at(&chart, place, &said(&what, tone.hertz, self.factor * tone.amplitude));
        }
        for &(hertz, amplitude) in &self.spurious {
            let place = (x(hertz), axes.y.position(amplitude).max(floor));
            mark(&chart, 2, place, 3.5, (BEFORE, Fill::Full))?;
            titles.at(&chart, place, &said("not in the fit", hertz, amplitude));
        }
        Ok(())
    }
}

fn panel<'a>(area: &Area<'a>, axes: &Axes, [x, y]: [&str; 2]) -> Drawn<Chart<'a>> {
    let (x, y) = ((&axes.x, x.to_owned()), (&axes.y, y.to_owned()));
    Panel { x, y, marks: [6, 5], title: String::new() }.draw(area)
}

/// An axis of time; `None` without a duration.
fn time(duration: f64) -> Option<Axis> {
    (duration.is_finite() && duration > 0.0).then(|| Axis::linear(0.0, duration))
}

/// Ranges as an area, at least a line wide.
fn ranges(chart: &Chart<'_>, of: &SampleRanges) -> Drawn {
    let SampleRanges { ranges, step, samples, .. } = of;
    let half = 0.5 * (step - step / *samples as f64);
    let middle = |place: usize| place as f64 * step + half;
    let high = ranges.iter().enumerate().map(|(place, [_, high])| (middle(place), *high));
    let low = ranges.iter().enumerate().rev().map(|(place, [low, _])| (middle(place), *low));
    let corners: Vec<(f64, f64)> = high.clone().chain(low).collect();
    if corners.len() > 2 {
        chart.plotting_area().draw(&Polygon::new(corners, EVEN.filled()))?;
    }
    let low = ranges.iter().enumerate().map(|(place, [low, _])| (middle(place), *low));
    for line in [high.collect::<Vec<(f64, f64)>>(), low.collect()] {
        chart.plotting_area().draw(&PathElement::new(line, stroke(AFTER, 0.75)))?;
    }
    Ok(())
}
