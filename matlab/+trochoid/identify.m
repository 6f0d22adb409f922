function answer = identify(case_, varargin)
%IDENTIFY  Cutting coefficients and runout from measured forces, with how well each is known.
%
%   answer = trochoid.identify(case_) of a case file, or of a struct of its tables.
%
%   See also trochoid.run, which says what the answer holds and which options there are.
answer = trochoid.run('identify', case_, varargin{:});
end
