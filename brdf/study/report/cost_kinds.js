// The measurements that a page of error against cost is of: their columns, and how a row is named.

const kErrorNames = {
  log1p_mae: {heading: 'log1p MAE', digits: 5, about: 'mean |ln(1 + f cos) − ln(1 + g cos)|'},
  logrel_mae: {heading: 'log-relative MAE', digits: 4, about: 'mean |ln((f w + 0.001) / (g w + 0.001))|'},
};

/// columns: in the order of the table. name(row): what has one colour. detail(row): which of that name a row is. part: a
/// column of which one value is shown at a time. costs, errors: columns to choose from. scale: of the error. limits, limit:
/// errors to ask for, and the first choice. shapes: of points, by detail; drawn says what they are. join: the points of a
/// name, or the best of all. recommend: one row of each name, or of all. guide: whether to draw an error that falls with the
/// root of the cost.
const kKinds = {
  copulas: {
    columns: {
      name: {heading: 'family', text: true},
      quantity: {heading: 'Quantity', text: true},
      accuracy: {heading: 'accuracy', text: true},
      theta: {heading: 'θ', digits: 3, about: 'the parameters, where Kendall’s τ is 1/2 or as near as it can be'},
      ns: {heading: 'time', unit: 'ns', digits: 1, about: 'a row, in a batch of all rows on one thread'},
      median_error: {heading: 'median error', digits: 1, about: 'relative, of log_pdf that of the logarithm'},
      max_error: {heading: 'largest error', digits: 1, about: 'the same, over all rows'},
    },
    name: (row) => row.family,
    detail: (row) => row.accuracy,
    part: 'quantity',
    costs: ['ns'],
    errors: ['max_error', 'median_error'],
    scale: 'digits',
    limits: [1e-5, 1e-13, 1e-50],
    limit: 1e-13,
    join: 'name',
    shapes: {fast: 'circle', standard: 'rect', symbolic: 'triangle', exact: 'rectRot'},
    drawn: 'Circles: fast. Squares: standard. Triangles: symbolic. Diamonds: exact. ',
    recommend: 'name',
    about: 'The levels of accuracy of each family, joined. An error of 0 is not drawn.',
    summary: () => `${data.n} points from each copula in dimension ${data.rows[0].d}, seed ${data.seed}; errors are against `
      + 'twice the digits of the level “exact”.',
  },
  models: {
    columns: {
      name: {heading: 'model', text: true},
      structure: {heading: 'structure', text: true, about: 'slices; or components × coefficients along θh and θd'},
      bytes: {heading: 'size', unit: 'B', digits: 0, about: 'bytes of everything that evaluation needs'},
      batch_ns: {heading: 'time in a batch', unit: 'ns', digits: 0, about: 'an RGB value, one thread'},
      single_ns: {heading: 'time alone', unit: 'ns', digits: 0, about: 'one RGB value a call'},
      fit_s: {heading: 'fit', unit: 's', digits: 1, about: 'wall clock of the fit on all threads'},
      ...kErrorNames,
    },
    name: (row) => `${row.mode} · ${row.family}`,
    detail: (row) => row.structure,
    costs: ['bytes', 'batch_ns', 'single_ns'],
    errors: Object.keys(kErrorNames),
    scale: 'log',
    join: 'best',
    drawn: '',
    recommend: 'all',
    about: 'The line joins those that no other beats in both.',
    summary: () => `Models of ${data.material}, from small to large: fitted and measured by the same code.`,
  },
  convergence: {
    columns: {
      name: {heading: 'sampler', text: true},
      samples: {heading: 'samples a pixel', digits: 0, about: 'paths'},
      seconds: {heading: 'time', unit: 's', digits: 2, about: 'of processor time, all threads together'},
      of_materials: {heading: 'error of the materials', digits: 4, about: 'rms over the pixels of the materials alone'},
      rms: {heading: 'rms error', digits: 4, about: 'root mean square over the mean of the picture'},
      relative: {heading: 'relative error', digits: 4, about: 'rms of each pixel’s difference over its own brightness'},
    },
    name: (row) => row.sampler,
    detail: (row) => (row.samples === 1 ? '1 sample' : `${row.samples} samples`),
    costs: ['samples', 'seconds'],
    errors: ['of_materials', 'rms', 'relative'],
    scale: 'log',
    join: 'name',
    recommend: 'all',
    guide: true,
    drawn: 'Dashed: an error that falls with the root of the cost, as that of independent samples does. ',
    about: 'Only how the materials draw directions differs. Each error is against two independent references.',
    summary: () => `${data.scene}, path traced.`,
  },
};
